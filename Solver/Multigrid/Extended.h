// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/OperatorSet.h"
#include "Solver/Multigrid/Setup/CoarsePoints.h"
#include "Solver/Multigrid/Setup/GalerkinProduct.h"
#include "Solver/Multigrid/Setup/Interpolation.h"
#include "Solver/Multigrid/Setup/InterpolationRow.h"
#include "Solver/Multigrid/Setup/Sparsification.h"
#include "smg/MeshSource.h"

namespace smg
{

/**
 * The default operator set. The C-points are those of the paper (Shi, Bao, Zhou 2009), a greedy
 * maximal independent set in stream order, but only strong edges count; the interpolation is
 * extended+i (De Sterck, Falgout, Nolting, Yang 2008) with few entries per row that
 * reproduce linear functions where weights cancel (LinearRows); the coarse operator is a sparsified
 * Galerkin product; the smoother is Gauss-Seidel in stream order, with exact solves on clusters of
 * slivers (Patches, OverlappingPatches). A node with a stiff row (see SliverRows) always gets a
 * coarse node of its own.
 *
 * Every step works in stream order on data that the window of a pass contains, so the hierarchy is
 * the same, bit for bit, for any window, block size and number of threads.
 *
 * Unlike the equations as the paper prints them it converges to the solution. The rate hardly
 * depends on the size of the mesh where cells are well shaped, or noisy but not refined; lattices
 * of slivers, which refinement makes of bad tetrahedra, slow it down (docs/performance.md).
 */
class Extended
{
public:
  static constexpr const char* name = "extended";
  using Relaxation = GaussSeidel;
  /** The steps may run on different threads: see canRunApart. */
  using Apart = Extended;

  /**
   * The parameters that measured best for each type of cell. docs/architecture.md ("The hierarchy")
   * lists the alternatives that were tried.
   *
   * Surfaces: a strength of 0.2 instead of 0.1 costs 5 to 10 % of memory and time per V-cycle and
   * saves up to a third of the V-cycles on real scans. For rows that cancel, 0.6 costs up to 1 % of
   * memory and saves a sixth to a half of the V-cycles on lattices of obtuse triangles; with rows
   * of P that reproduce linear functions these take 7 to 15 instead of 13 to 22, refined five
   * times. Tetrahedra: a strength of 0 would count the small weights of slivers as strong, and
   * values above 0.1 cost more memory than the V-cycles that they save are worth. Keeping all
   * entries of rows that cancel only a little, and negative weights without a common neighbour,
   * pays off only on surfaces.
   *
   * Most of the set-up is the Galerkin product from the finest level to the next one. Fewer entries
   * per row of P there (finestEntries) save part of it where no sliver needs more. A second sweep
   * of the interpolation saves at most an eighth of the V-cycles on slivers, and adds a ring to
   * every window.
   */
  static Extended forCells(CellType type)
  {
    Extended set;
    // The defaults of the parts are those for triangles, except for the product, which other sets
    // have, too.
    set.Product.cancelling = 1.1;
    if (type == CellType::Tetrahedron)
    {
      set.Interpolation.coarsePoints = { 0.08F, 0.08F, 1.5F };
      set.Interpolation.entries = 5;
      set.Product.cancelling = 1.5;
      set.Sparsify.dropsNegative = true;
      set.PatchRings = 2;
    }
    return set;
  }

  /** For a small, fixed number of V-cycles: each V-cycle is up to twice as effective, and the
   * set-up takes longer. */
  static Extended forFewCycles(CellType type)
  {
    Extended set = forCells(type);
    set.Interpolation.finestEntries = set.Interpolation.entries;
    if (type == CellType::Tetrahedron)
    {
      set.Interpolation.coarsePoints.strength = 0.05F;
      set.Interpolation.coarsePoints.cancellingStrength = 0.05F;
      set.Interpolation.sweeps = 2;
    }
    return set;
  }

  /** See Patches::setRings(). */
  int patchRings() const { return this->PatchRings; }
  bool readsPositions() const { return this->Interpolation.linear; }
  bool isCoarse(const CoarseningData& data, std::int64_t i) const
  {
    return this->Interpolation.coarsePoints(data, i);
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
    appendRounded(data, i, data.relaxed[i]);
  }
  void productAP(CoarseningData& data, std::int64_t i) { this->Product.productAP(data, i); }
  void productPtAP(CoarseningData& data, std::int64_t c) { this->Product.productPtAP(data, c); }
  void sparsify(CoarseningData& data, std::int64_t c) const { this->Sparsify(data, c); }

private:
  ExtendedInterpolation Interpolation;
  GalerkinProduct Product;
  Sparsification Sparsify;
  int PatchRings = 1;
};

static_assert(OperatorSet<Extended> && canRunApart<Extended>);

} // namespace smg
