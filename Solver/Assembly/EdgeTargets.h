// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/WeightedEdges.h"
#include "Solver/Memory/Ring.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The targets of the edges of a batch of rows, queried from a problem with edge targets in one
 * call. */
class SMG_EXPORT EdgeTargets
{
public:
  /** `points`: the positions of all open vertices. */
  EdgeTargets(Problem& problem, const Ring<double>& points)
    : Given(problem)
    , Points(points)
    , Any(problem.hasEdgeTargets())
    , Columns(static_cast<std::size_t>(problem.columns()))
  {
  }

  /** Whether the problem has any. */
  bool any() const { return this->Any; }

  /** Queries those of the rows from `first` on, if the problem has any: the neighbours of each row
   * end at the number in `ends`. Throws Error if one is not finite. */
  void ask(std::int64_t first, std::span<const RowNeighbour> neighbours,
    std::span<const std::size_t> ends);

  /** `columns` values for each neighbour from number `neighbour` of the batch on; null: none. */
  const double* at(std::size_t neighbour) const
  {
    return this->Any ? this->Targets.data() + neighbour * this->Columns : nullptr;
  }

private:
  Problem& Given;
  const Ring<double>& Points;
  bool Any;
  std::size_t Columns;
  std::vector<std::int64_t> From, To;
  std::vector<double> FromPoints, ToPoints, Targets;
};

} // namespace smg
