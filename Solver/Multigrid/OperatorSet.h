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
 * An operator set: the pluggable part of the multigrid. A default-constructible, copyable type O
 * (every level gets a copy) with
 *
 *   const char* O::name             its name
 *   O O::forCells(CellType)         the set with the parameters that are best for such cells
 *   bool o.isCoarse(data, i)            choice of C-points: whether node i is one
 *   o.interpolateInitial(data, i)   interpolation in three steps: an initial row i of P,
 *   o.interpolationSweeps()         sweeps that improve the rows, at least 1, each with
 *   o.relaxInterpolation(data, i)   a relaxation of row i,
 *   o.interpolate(data, i)          and the final row i
 *   o.productAP(data, i)             coarse operator in three steps: row i of A P,
 *   o.productPtAP(data, c)               row c of P^T A P,
 *   o.sparsify(data, c)             and its sparsification
 *   O::Relaxation                   see Solver/Multigrid/Cycle/GaussSeidel.h
 *   o.patchRings()                  optional: see Patches::setRings()
 *   O::Apart                        optional, the type O itself: see canRunApart
 *
 * Restriction is the transpose of interpolation. Coarsening calls each step once for each fine node
 * i or coarse node c, in ascending order, on windows that hold only the following data; a step that
 * reads anything else reads released memory. `data.fine` are the rows of the fine level.
 *
 * - `isCoarse` may read row i and `coarseIndex` of the nodes below, and returns the decision. A
 * node whose row is stiff (see SliverRows) should be a C-point.
 * - `interpolateInitial` may read row i and `coarseIndex` of its neighbours, and appends row i of
 *   `initial` and its `initialTotal`.
 * - `relaxInterpolation` may read row i, and of i and its neighbours `coarseIndex`, `initial` and
 *   `relaxed`, which is Pending before the first sweep. It sets `relaxed` of i; for the nodes of a
 *   patch, all of which it may then read in this way, when called for the last node.
 * - `interpolate` may read `relaxed` of i. It appends row i of `interpolation`, chained by columns
 *   from `firstChild` to `lastChild`, and sets `rowQuanta` and `parentReach`.
 * - `productAP` may read row i and `interpolation` of i and its neighbours. It appends row i of
 *   `product` and sets `productSum`.
 * - `productPtAP` may read the chain of column c and `product` of its rows. It appends row c to
 *   `gathered`, by ascending column; the row is stiff if `data.stiff`, called once, returns true.
 * - `sparsify`, which follows it, finds the gathered rows in `raw`. It may read those up to c that
 *   have neighbours from c on, and modify their upper entries, those with delta > 0; their weights
 *   are finally copied to the lower ones. CoarseEntry::remove() marks an entry as removed.
 *
 * Requirements of the engine: a node without edges is an F-point; each C-point has a child; P
 * has entries from -1 to 1 (multiples of 1/Quanta), from coarse nodes within two rings; the coarse
 * operator is exactly symmetric, with row sums rowSum that are zero where no constraint reaches,
 * before and after sparsification; a step depends only on what it may read, not on when it is
 * called. To replace one step, derive from Extended and hide that member, see
 * Examples/CustomOperators.
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

/** Whether five threads may run the steps up to interpolateInitial(), those up to interpolate(),
 * productAP(), productPtAP() and sparsify(): these share no data but those of CoarseningData, and
 * rows of P have at most RelaxedRow::Most entries. A set derived from such a one must say so again,
 * since it may replace any step. */
template <class O>
inline constexpr bool canRunApart = requires
{
  requires std::same_as<typename O::Apart, O>;
};

template <class O>
int patchRingsOf(const O& set)
{
  if constexpr (requires { set.patchRings(); })
  {
    return set.patchRings();
  }
  return 1;
}

} // namespace smg
