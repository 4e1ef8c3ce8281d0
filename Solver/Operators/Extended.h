// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/GaussSeidel.h"
#include "Solver/Hierarchy/ExtendedInterpolation.h"
#include "Solver/Hierarchy/GalerkinProduct.h"
#include "Solver/Hierarchy/Lifting.h"
#include "Solver/Hierarchy/Sparsification.h"
#include "Solver/Operators/OperatorSet.h"

namespace smg
{

/**
 * The default operator set: the paper's lifting rule on strong edges, extended interpolation, the
 * sparsified Galerkin product and Gauss-Seidel relaxation in stream order. Nodes whose rows are
 * stiff (see StiffRows) have a coarse node each. Unlike the paper's printed equations it converges
 * to the solution, at a rate that hardly depends on the mesh's size.
 */
class Extended
{
public:
  static constexpr const char* name = "extended";
  using Relaxation = GaussSeidel;

  /**
   * The parameters that were best by trial. A strength of 0.2 instead of 0.1 on surfaces costs 5 to
   * 10 % of memory and time a V-cycle and saves up to a third of the V-cycles on real scans; on
   * tetrahedra one of 0 takes the small weights of slivers for strong ones, one above 0.1 takes
   * more memory than it saves V-cycles. Keeping rows that cancel little pays on surfaces alone.
   *
   * Most of the set-up's work is the product from the finest level to the next one. Fewer entries
   * there save some of it where slivers do not need them. A second sweep of the interpolation saves
   * an eighth of the V-cycles on slivers at most, and takes a ring more of every window.
   */
  static Extended forCells(CellType type)
  {
    Extended set = forFewCycles(type);
    const bool surface = type == CellType::Triangle;
    set.Interpolation.lifting.strength = surface ? 0.2F : 0.08F;
    set.Interpolation.finestEntries = 3;
    set.Interpolation.sweeps = 1;
    return set;
  }

  /** Parameters for a given number of V-cycles: each is up to twice as good, the set-up longer. */
  static Extended forFewCycles(CellType type)
  {
    Extended set;
    const bool surface = type == CellType::Triangle;
    set.Interpolation.lifting.strength = surface ? 0.2F : 0.05F;
    set.Interpolation.entries = surface ? 4 : 5;
    set.Interpolation.finestEntries = set.Interpolation.entries;
    set.Interpolation.cancelling = surface ? 1.2F : 1.5F;
    set.Interpolation.sweeps = surface ? 1 : 2;
    set.Product.cancelling = surface ? 1.1 : 1.5;
    return set;
  }

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
};

static_assert(OperatorSet<Extended>);

} // namespace smg
