// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/MeshSource.h"

#include <concepts>
#include <cstdint>

namespace smg
{

/**
 * An operator set: the part of the multigrid that a program can replace. It is a
 * default-constructible, copyable type O (every level gets a copy) with
 *
 *   const char* O::name             its name
 *   O O::forCells(CellType)         the set with the best parameters for such cells
 *   bool o.isCoarse(data, i)        choice of C-points: whether node i is one
 *   o.interpolateInitial(data, i)   interpolation in three steps: an initial row i of P,
 *   o.interpolationSweeps()         the number of sweeps that improve the rows, at least 1,
 *   o.relaxInterpolation(data, i)   the relaxation of row i in such a sweep,
 *   o.interpolate(data, i)          and the final row i
 *   o.productAP(data, i)            coarse operator in three steps: row i of A P,
 *   o.productPtAP(data, c)          row c of P^T A P,
 *   o.sparsify(data, c)             and its sparsification
 *   O::Relaxation                   the smoother: see Solver/Multigrid/Cycle/GaussSeidel.h
 *   o.patchRings()                  optional: see Patches::setRings(); with 2 the finest level also
 *                                   has OverlappingPatches
 *   o.readsPositions()              optional: whether the steps read positions of nodes
 *   O::Apart                        optional, the type O itself: see canRunApart
 *
 * Restriction is the transpose of interpolation. Coarsening calls each step once for each fine node
 * i or coarse node c, in ascending order. The windows guarantee only the following data; a step
 * that reads anything else reads released memory. `data.fine` has the rows of the fine level; with
 * a row come its row sum, its stiffness and `data.patches.diagonal()`.
 *
 * - `isCoarse` may read row i and the `coarseIndex` of nodes below i, and returns the decision. A
 *   node whose row is stiff (see SliverRows) should be a C-point.
 * - `interpolateInitial` may read row i and the `coarseIndex` of its neighbours. It appends row i
 *   of `initial` and its `initialTotal`.
 * - `relaxInterpolation` may read, of i and its neighbours, the rows, `coarseIndex`, `initial`,
 *   `initialTotal` and `relaxed`, which is Pending before the first sweep. It sets `relaxed` of i.
 *   It may instead set all rows of a patch in the call for the last node of the patch; in that call
 *   it may read the same data of every member and of the neighbours of the members. If the set
 *   reads positions and the nodes have any (LevelRows::isPlaced()), it may read those of the nodes
 *   that it sets and of the coarse nodes in rows that it may read.
 * - `interpolate` may read `relaxed` of i. It appends row i of `interpolation`, links its entries
 *   into the chains of their columns (`firstChild` to `lastChild`), sets `rowQuanta` and appends to
 *   `parentReach`.
 * - `productAP` may read row i, and `interpolation` and `rowQuanta` of i and its neighbours. It
 *   appends row i of `product` and sets `productSum`.
 * - `productPtAP` may read the chain of column c, and `product` and `productSum` of the rows in it.
 *   It appends row c to `gathered`, by ascending column. It calls `data.stiff` once; the row is
 *   stiff if that returns true.
 * - `sparsify`, which follows, finds the gathered rows in `raw`. Of the rows up to c, those with a
 *   neighbour at or above c are in memory. It may modify their upper entries, those with delta > 0,
 *   and mark an entry as removed (CoarseEntry::remove()); finishRow() later copies the upper
 *   weights to the mirrored lower entries.
 *
 * What the engine requires: a node without edges is an F-point; each C-point has a child; the
 * entries of P lie in [-1, 1], are multiples of 1/Quanta and belong to coarse nodes within two
 * rings; the coarse operator is exactly symmetric, and before and after sparsification its row sums
 * are rowSum, which is zero where no constraint reaches; a step depends only on what it may read,
 * not on when it is called. To replace a single step, derive from Extended and hide that member, as
 * Examples/CustomOperators does.
 */
template <class O>
concept OperatorSet = std::default_initializable<O> && std::copyable<O> &&
  requires(O o, CoarseningData& data, std::int64_t i, CellType type)
{
  {
    O::name
    } -> std::convertible_to<const char*>;
  {
    O::forCells(type)
    } -> std::same_as<O>;
  {
    o.isCoarse(data, i)
    } -> std::same_as<bool>;
  o.interpolateInitial(data, i);
  {
    o.interpolationSweeps()
    } -> std::same_as<int>;
  o.relaxInterpolation(data, i);
  o.interpolate(data, i);
  o.productAP(data, i);
  o.productPtAP(data, i);
  o.sparsify(data, i);
  typename O::Relaxation;
  requires Relaxation<typename O::Relaxation>;
};

/**
 * Whether five threads may run the steps of a set at the same time: one those up to
 * interpolateInitial(), one those up to interpolate(), and one each productAP(), productPtAP() and
 * sparsify(). It requires that these groups share no data except through CoarseningData, and that
 * rows of P have at most RelaxedRow::Most entries. A set declares it by an alias Apart of its own
 * type. A derived set has to declare it again, since it may replace any step.
 */
template <class O>
inline constexpr bool canRunApart = requires
{
  requires std::same_as<typename O::Apart, O>;
};

/** The rings of a patch: set.patchRings() if the set has that member, otherwise 1. */
template <class O>
int patchRingsOf(const O& set)
{
  if constexpr (requires { set.patchRings(); })
  {
    return set.patchRings();
  }
  return 1;
}

/** Whether the steps of a set read positions of nodes: set.readsPositions(), or false without that
 * member. */
template <class O>
bool readsPositionsOf(const O& set)
{
  if constexpr (requires { set.readsPositions(); })
  {
    return set.readsPositions();
  }
  return false;
}

} // namespace smg
