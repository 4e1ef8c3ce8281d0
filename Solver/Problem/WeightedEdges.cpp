// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/WeightedEdges.h"

#include "Solver/Problem/EdgeWeightError.h"

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
  this->Edges.take(from, this->Row);
  if (this->Scales)
  {
    this->Scales->take(from, this->RowScales);
  }
  const std::size_t before = neighbours.size();
  neighbours.resize(before + this->Row.size());
  RowNeighbour* out = neighbours.data() + before;
  for (std::size_t e = 0; e < this->Row.size(); ++e)
  {
    const std::int64_t to = this->Row[e].to;
    double weight = this->Row[e].weight;
    if (weight == Elsewhere)
    {
      continue;
    }
    if (this->Kind == Weights::Clamped)
    {
      // 0: only flat cells have the edge.
      const double least = this->Scales ? this->RowScales[e].weight : 0.0;
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
