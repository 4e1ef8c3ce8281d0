// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/CellWeights.h"

#include <cstddef>
#include <span>
#include <vector>

namespace smg
{

/** The gradients and fluxes of the cells of a block, and the energy of all cells. */
class CellResults
{
public:
  /** `gradient`, `flux`: whether they are requested. */
  CellResults(CellType type, int columns, bool gradient, bool flux);

  /** Starts the next block, of this many cells. */
  void begin(std::size_t cells);
  /** Adds cell c of the block: the positions of its corners, the values there (`columns` each), its
   * weights, the factor by which the solve has reduced these, and K (null: the identity). */
  void add(std::size_t c, const double* const* points, const double* const* values,
    const CellWeights& weights, double flatness, const double* K);

  /** grad u in the block: 3 * `columns` numbers per cell, 0 in cells without measure. */
  std::span<const double> gradient() const { return this->Gradient; }
  /** -K grad u, likewise. */
  std::span<const double> flux() const { return this->Flux; }
  /** Per column: 1/2 the integral of grad u . K grad u, and the part of it that the solve has
   * omitted. */
  const std::vector<double>& energy() const { return this->Energy; }
  const std::vector<double>& leftOut() const { return this->LeftOut; }

private:
  CellType Type;
  int Columns;
  bool WantsGradient, WantsFlux;
  std::vector<double> Gradient, Flux, Energy, LeftOut;
};

} // namespace smg
