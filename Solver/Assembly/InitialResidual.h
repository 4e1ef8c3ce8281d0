// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Setup/RowEntry.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** A completed row of the finest level. */
struct AssembledRow
{
  std::int64_t vertex;
  const RowEntry* entries;
  std::span<const double> weights; ///< of the entries
  double diagonal;
};

/** The residual b - A x_0 of the initial values, summed up row by row. */
class InitialResidual
{
public:
  /** `values`: x_0 of a vertex and its neighbours when its row is added. */
  explicit InitialResidual(const Ring<double>& values)
    : Values(values)
    , OfRow(static_cast<std::size_t>(values.lanes()))
  {
  }

  /** Adds a row, whose residual counts as `share` (see commonShare()); returns its residual, a
   * number per column. */
  std::span<const double> add(const AssembledRow& row, std::span<const double> b, double share);

  /** ||b - A x_0||^2 with the shares. */
  double squares() const { return this->Squares; }
  /** The sum of the squares of its terms b_i and A_ii x_i. */
  double termSquares() const { return this->TermSquares; }

private:
  const Ring<double>& Values;
  std::vector<double> OfRow;
  double Squares = 0.0, TermSquares = 0.0;
};

} // namespace smg
