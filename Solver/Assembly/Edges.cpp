// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Edges.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

// The weights of the edges of a mesh stream, and the targets of a problem with edge targets.
//
// The lower vertex of an edge stores the sum over its cells, which is accumulated in the order of
// the stream and passed to the upper vertex as it is. So both rows of an edge get the same double,
// which neither blocks nor threads change. The floor of Weights::Clamped is applied when a row
// takes its edges: at both ends from the same numbers.
//
// Expected constant time per edge of a cell; memory for the open vertices only, those that may
// still get cells.

namespace smg
{

EdgeStiffness::EdgeStiffness(Pool& pool, const Problem& problem, CellType type)
  : Type(type)
  , Kind(problem.weights())
  , Edges(pool, OpenEdges::usual(type))
{
  if (problem.hasCells() && this->Kind == Weights::Clamped)
  {
    // Only a conductivity or weights of the problem scale the floor; otherwise it is the same for
    // all cells.
    this->Scales.emplace(pool, OpenEdges::usual(type));
  }
}

void EdgeStiffness::extend(std::int64_t vertices)
{
  this->Edges.extend(vertices);
  if (this->Scales)
  {
    this->Scales->extend(vertices);
  }
}

void EdgeStiffness::release(std::int64_t first)
{
  this->Edges.release(first);
  if (this->Scales)
  {
    this->Scales->release(first);
  }
}

void EdgeStiffness::take(
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
    // Before the floor, which would raise -infinity to a weight.
    if (weight == Elsewhere)
    {
      continue;
    }
    if (this->Kind == Weights::Clamped)
    {
      // add() enters every edge in both lists at the same time, so they have the same order. A
      // scale of 0 says that only flat cells have the edge; the floor then is the one for K = 1.
      const double least =
        this->Scales ? this->RowScales[static_cast<std::size_t>(edge - first)].weight : 0.0;
      const double floor =
        (least > 0.0 ? least : 1.0) * cotangentFloor(this->Type, points.at(from), points.at(to));
      this->Clamped += weight < floor ? 1 : 0;
      weight = std::max(weight, floor);
    }
    // Rows store weights in single precision.
    if (!std::isfinite(static_cast<float>(weight)))
    {
      throw EdgeWeightError(from, to, std::to_string(from), std::to_string(to));
    }
    // Written over the list that is read: `out` is never ahead of `edge`.
    *out++ = { to, weight };
  }
  neighbours.resize(static_cast<std::size_t>(out - neighbours.data()));
}

void EdgeTargets::ask(
  std::int64_t first, std::span<const RowNeighbour> neighbours, std::span<const std::size_t> ends)
{
  if (!this->Any)
  {
    return;
  }
  const std::size_t edges = neighbours.size();
  this->From.resize(edges);
  this->To.resize(edges);
  this->FromPoints.resize(3 * edges);
  this->ToPoints.resize(3 * edges);
  this->Targets.assign(edges * this->Columns, 0.0);
  std::size_t row = 0;
  for (std::size_t e = 0; e < edges; ++e)
  {
    // Also skips rows without edges.
    while (e >= ends[row])
    {
      ++row;
    }
    this->From[e] = first + static_cast<std::int64_t>(row);
    this->To[e] = neighbours[e].to;
    std::copy_n(this->Points.at(this->From[e]), 3, this->FromPoints.data() + 3 * e);
    std::copy_n(this->Points.at(this->To[e]), 3, this->ToPoints.data() + 3 * e);
  }
  EdgeBatch batch{ this->From, this->To, this->FromPoints, this->ToPoints, this->Targets };
  this->Given.edgeTargets(batch);
  // A target that is not finite would make the whole solution NaN.
  if (!std::ranges::all_of(this->Targets, [](double v) { return std::isfinite(v); }))
  {
    throw Error("an edge target near vertex " + std::to_string(first) + " is not a finite number");
  }
}

} // namespace smg
