// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"

#include <cstddef>
#include <span>
#include <vector>

namespace smg
{

/** The gradients and fluxes of cells, a block at a time, and the energy of all. */
class CellResults
{
public:
  /** `gradient`, `flux`: whether they are wanted. */
  CellResults(CellType type, int columns, bool gradient, bool flux);

  /** Begins the next block, of so many cells. */
  void begin(std::size_t cells);
  /**
   * Cell c of the block: positions of its corners, values there (`columns` each), its weights, the
   * factor by which the solve has scaled these down, and K (null: the identity).
   */
  void add(std::size_t c, const double* const* points, const double* const* values,
    const CellWeights& weights, double flatness, const double* K);

  /** Of the block: 3 * `columns` numbers a cell, 0 in cells without measure. */
  std::span<const double> gradient() const { return this->Gradient; }
  /** -K grad u, likewise. */
  std::span<const double> flux() const { return this->Flux; }
  /** Per column: 1/2 the integral of grad u . K grad u, and how much of that the solve has left
   * out. */
  const std::vector<double>& energy() const { return this->Energy; }
  const std::vector<double>& leftOut() const { return this->LeftOut; }

private:
  CellType Type;
  int Columns;
  bool WantsGradient, WantsFlux;
  std::vector<double> Gradient, Flux, Energy, LeftOut;
};

} // namespace smg
