// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/EdgeTargets.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{

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
  if (!std::ranges::all_of(this->Targets, [](double v) { return std::isfinite(v); }))
  {
    throw Error("an edge target near vertex " + std::to_string(first) + " is not a finite number");
  }
}

} // namespace smg
