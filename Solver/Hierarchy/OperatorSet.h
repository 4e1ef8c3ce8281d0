// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Stream/MeshSource.h"

#include <concepts>
#include <cstdint>

namespace smg
{

/**
 * An operator set: the pluggable part of the multigrid. A type O with a default constructor and
 *
 *   O::name                         what `--operators` calls it
 *   O::forCells(CellType)           the set with its parameters for that kind of cells
 *   bool o.lift(data, i)            lifting rule: does node i get a parent?
 *   void o.interpolateInitial(data, i), o.interpolate(data, i)
 *                                   interpolation in two steps; each appends row i
 *   void o.multiply(data, i), o.gather(data, c), o.sparsify(data, c)
 *                                   coarse operator in three steps
 *   O::Relaxation                   relaxation; see Solver/Cycle/GaussSeidel.h
 *
 * Each step may read what CoarseningData says is there when Coarsening calls it; restriction is the
 * transpose of interpolation.
 */
template <class O>
concept OperatorSet = std::default_initializable<O> &&
  requires(O o, CoarseningData& data, std::int64_t i, CellType type)
{
  {
    O::name
    } -> std::convertible_to<const char*>;
  {
    O::forCells(type)
    } -> std::same_as<O>;
  {
    o.lift(data, i)
    } -> std::same_as<bool>;
  o.interpolateInitial(data, i);
  o.interpolate(data, i);
  o.multiply(data, i);
  o.gather(data, i);
  o.sparsify(data, i);
  typename O::Relaxation;
};

} // namespace smg
