// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/ExtendedParameters.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/ExtendedInterpolation.h"
#include "Solver/Multigrid/Setup/GalerkinProduct.h"
#include "Solver/Multigrid/Setup/Lifting.h"
#include "Solver/Multigrid/Setup/Sparsification.h"

namespace smg
{

/**
 * The default operator set: the paper's lifting rule on strong edges, extended interpolation, the
 * sparsified Galerkin product and Gauss-Seidel relaxation in stream order. Nodes with stiff rows
 * (see StiffRows) have their own coarse nodes. Unlike the paper's printed equations it converges to
 * the solution. The rate hardly depends on the size of the mesh where cells are well shaped, or
 * noisy but not refined; lattices of slivers, which refinement makes of bad cells, slow it down
 * (docs/performance.md).
 */
class Extended
{
public:
  static constexpr const char* name = "extended";
  using Relaxation = GaussSeidel;
  using Apart = Extended;

  Extended() = default;
  explicit Extended(const ExtendedParameters& parameters)
  {
    this->Interpolation.lifting.strength = parameters.strength;
    this->Interpolation.lifting.sliverStrength = parameters.sliverStrength;
    this->Interpolation.lifting.cancelling = parameters.cancelling;
    this->Interpolation.finestEntries = parameters.finestEntries;
    this->Interpolation.entries = parameters.entries;
    this->Interpolation.sweeps = parameters.sweeps;
    this->Product.cancelling = parameters.coarseCancelling;
    this->Sparsify.dropsNegative = parameters.dropsNegative;
    this->PatchRings = parameters.patchRings;
  }

  static Extended forCells(CellType type) { return Extended(ExtendedParameters::forCells(type)); }
  static Extended forFewCycles(CellType type)
  {
    return Extended(ExtendedParameters::forFewCycles(type));
  }

  /** See Patches::setRings(). */
  int patchRings() const { return this->PatchRings; }
  bool lift(const CoarseningData& data, std::int64_t i) const
  {
    return this->Interpolation.lifting(data, i);
  }
  void interpolateInitial(CoarseningData& data, std::int64_t i) const
  {
    this->Interpolation.initial(data, i);
  }
  int interpolationSweeps() const { return this->Interpolation.sweeps; }
  void relaxInterpolation(CoarseningData& data, std::int64_t i)
  {
    this->Interpolation.relax(data, i);
  }
  void interpolate(CoarseningData& data, std::int64_t i) const
  {
    this->Interpolation.append(data, i);
  }
  void multiply(CoarseningData& data, std::int64_t i) { this->Product.multiply(data, i); }
  void gather(CoarseningData& data, std::int64_t c) { this->Product.gather(data, c); }
  void sparsify(CoarseningData& data, std::int64_t c) const { this->Sparsify(data, c); }

private:
  ExtendedInterpolation Interpolation;
  GalerkinProduct Product;
  Sparsification Sparsify;
  int PatchRings = 1;
};

static_assert(OperatorSet<Extended> && canRunApart<Extended>);

} // namespace smg
