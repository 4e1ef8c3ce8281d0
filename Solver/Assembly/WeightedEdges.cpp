// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/WeightedEdges.h"

#include "Solver/Assembly/EdgeWeightError.h"

#include <cmath>
#include <string>

namespace smg
{

WeightedEdges::WeightedEdges(Pool& pool, const Problem& problem, CellType type)
  : Type(type)
  , Kind(problem.weights())
  , Edges(pool, OpenEdges::usual(type))
{
  if (problem.hasCells() && this->Kind == Weights::Clamped)
  {
    this->Scales.emplace(pool, OpenEdges::usual(type));
  }
}

void WeightedEdges::extend(std::int64_t vertices)
{
  this->Edges.extend(vertices);
  if (this->Scales)
  {
    this->Scales->extend(vertices);
  }
}

void WeightedEdges::release(std::int64_t first)
{
  this->Edges.release(first);
  if (this->Scales)
  {
    this->Scales->release(first);
  }
}

void WeightedEdges::take(
  std::int64_t from, const Ring<double>& points, std::vector<RowNeighbour>& neighbours)
{
  const std::size_t before = neighbours.size();
  this->Edges.take(from, neighbours);
  if (this->Scales)
  {
    this->RowScales.clear();
    this->Scales->take(from, this->RowScales);
  }
  const RowNeighbour* first = neighbours.data() + before;
  const RowNeighbour* last = neighbours.data() + neighbours.size();
  RowNeighbour* out = neighbours.data() + before;
  for (const RowNeighbour* edge = first; edge != last; ++edge)
  {
    const std::int64_t to = edge->to;
    double weight = edge->weight;
    if (weight == Elsewhere)
    {
      continue;
    }
    if (this->Kind == Weights::Clamped)
    {
      // 0: only flat cells have the edge.
      const double least =
        this->Scales ? this->RowScales[static_cast<std::size_t>(edge - first)].weight : 0.0;
      const double floor =
        (least > 0.0 ? least : 1.0) * cotangentFloor(this->Type, points.at(from), points.at(to));
      this->Clamped += weight < floor ? 1 : 0;
      weight = std::max(weight, floor);
    }
    if (!std::isfinite(static_cast<float>(weight)))
    {
      throw EdgeWeightError(from, to, std::to_string(from), std::to_string(to));
    }
    *out++ = { to, weight };
  }
  neighbours.resize(static_cast<std::size_t>(out - neighbours.data()));
}

} // namespace smg
