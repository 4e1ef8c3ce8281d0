// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/WeightedCells.h"
#include "Solver/Problem/IntegratedParts.h"
#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Integrals over the cells of a part. */
struct PartSums
{
  double measure = 0.0;
  std::vector<double> gradient, flux; ///< 3 * `columns` numbers
};

/** The same of a group of cells, with the integral of u: `columns` numbers. */
struct IntegralSums
{
  PartSums part;
  std::vector<double> value;
};

/** The gradients and fluxes of the cells of a block, and the sums over all cells. */
class CellResults
{
public:
  /** `gradient`, `flux`: whether they are requested. `parts`: see ConditionCounts. */
  CellResults(CellType type, int columns, bool gradient, bool flux, int parts,
    IntegratedParts integrated = {});

  /** Starts the next block. */
  void begin(const MeshBlock& block);
  /** Integrates over a cell, which add() follows: u has these values at the corners. */
  void integrate(const WeightedCell& cell, const double* const* values);
  /** Adds a cell of the block with the values at its corners, `columns` each. Without data of the
   * problem K is the identity, and the cell is in no part. */
  void add(const WeightedCell& cell, const double* const* values);

  /** grad u in the block: 3 * `columns` numbers per cell, 0 in cells without measure. */
  std::span<const double> gradient() const { return this->Gradient; }
  /** -K grad u, likewise. */
  std::span<const double> flux() const { return this->Flux; }
  /** Per column: 1/2 the integral of grad u . K grad u, and the part of it that the solve has
   * omitted. */
  const std::vector<double>& energy() const { return this->Energy; }
  const std::vector<double>& leftOut() const { return this->LeftOut; }
  /** Per column: the energy of the cell that was added last. */
  const std::vector<double>& energyOfCell() const { return this->OfCell; }
  /** One of each part, and one of all other cells; empty without parts. */
  const std::vector<PartSums>& parts() const { return this->Parts; }
  /** One of each of the integrated parts. */
  const IntegratedParts& integrated() const { return this->Integrated; }
  const std::vector<IntegralSums>& integrals() const { return this->Integrals; }

private:
  /** The integrated parts that a cell is in. */
  const std::vector<std::uint32_t>& partsOf(const WeightedCell& cell) const
  {
    return this->Integrated.ofSet[this->Sets.empty() ? 0 : this->Sets[cell.number]];
  }

  CellType Type;
  int Columns;
  bool WantsGradient, WantsFlux;
  std::vector<double> Gradient, Flux, Energy, LeftOut, OfCell;
  std::vector<PartSums> Parts;
  IntegratedParts Integrated;
  std::vector<IntegralSums> Integrals;
  std::span<const GroupSet> Sets; // of the cells of the block; empty: all 0
  std::vector<PartSums*> Into;    // what a cell is added to
};

} // namespace smg
