// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "smg/Export.h"

#include <array>
#include <cstdint>
#include <type_traits>

// A sweep over a block of a level. A relaxation is a template; for the engine it becomes a table of
// functions, one for each kind of block and of values, so that the engine is compiled once. A call
// treats a block, and in it the compiler sees the types of all arrays.

namespace smg
{

template <class Real>
class LevelWindow;

/**
 * Relaxes the nodes of a patch b together: x_b += A_bb^-1 (b - A x)_b. The members may lie in
 * several blocks of the window. The same for each relaxation.
 */
template <class Real>
class SMG_EXPORT PatchRelaxation
{
public:
  PatchRelaxation(const LevelWindow<Real>& window, const Ring<Real>& x, const Ring<Real>& b)
    : Window(&window)
    , X(&x)
    , B(&b)
  {
  }

  /** Relaxes the patch whose last member is `node`, in the block of the part: the columns that the
   * part points to. `lowerOnly`: see Relaxation. */
  void operator()(const BlockPart<Real>& part, const RowBlock::Special& node, bool lowerOnly) const;

private:
  template <bool LowerOnly, class Vectors>
  void relax(const BlockPart<Real>& part, const RowBlock::Special& node) const;

  const LevelWindow<Real>* Window;
  const Ring<Real>*X, *B;
};

extern template class PatchRelaxation<double>;
extern template class PatchRelaxation<float>;

/**
 * A sweep of a Relaxation over a part of a block. Ordinary nodes are relaxed one by one. With
 * `patches` the nodes of a patch are relaxed together, at its last member. Only the first sweep of
 * each half of a V-cycle does so: behind a sweep that relaxes node by node the next stage waits for
 * neighbours only, not for the ends of patches, so the window is shorter.
 */
template <class Relaxation, class Real, bool LowerOnly, int Count, class Index, class Weight>
void sweepBlock(BlockPart<Real> part, const PatchRelaxation<Real>* patches)
{
  using Vectors = SimdPack<Real, Count>;
  const RowBlock::Header& h = part.header();
  const auto a = part.block.template arrays<Index, Weight>();
  const std::int64_t stride = Count == 1 ? 1 : part.stride; // a constant for one column
  for (; part.lane < stride; part.lane += Count, part.x += Count, part.b += Count)
  {
    for (NodeRuns runs(h, a, part.nodes); runs.next();)
    {
      const RowBlock::Special* special = runs.special();
      if (!special)
      {
        Relaxation::template sweep<LowerOnly, Vectors>(
          h, a, runs.nodes(), stride, part.x, static_cast<const Real*>(part.b));
      }
      else if (special->size == 1 || !patches)
      {
        // Alone, by its precise weights if it has some.
        visitSpecial<Real>(h, a, *special,
          [&](const auto& row)
          {
            Relaxation::template sweep<LowerOnly, Vectors>(
              h, row, runs.nodes(), stride, part.x, static_cast<const Real*>(part.b));
          });
      }
      else if (special->size > 1)
      {
        (*patches)(part, *special, LowerOnly);
      }
      else if (LowerOnly)
      {
        // It waits for the last member. x is not initialised in this sweep, but the last member and
        // nodes between read it as zero.
        const typename Vectors::Vector zero{};
        Vectors::store(part.x + special->node * stride, zero);
      }
    }
  }
}

/** The sweeps of a relaxation over every kind of block. */
template <class Real>
struct SweepTable
{
  using Function = void (*)(BlockPart<Real> part, const PatchRelaxation<Real>* patches);
  /** By the weights and indices of the block: floats, wide floats, rounded, wide and rounded. */
  using Kinds = std::array<Function, 4>;

  template <class Relaxation, bool LowerOnly, int Count>
  static constexpr Kinds kindsOf()
  {
    // There are no rounded weights on the finest level.
    using Rounded = std::conditional_t<std::is_same_v<Real, double>, float, BFloat16>;
    return { &sweepBlock<Relaxation, Real, LowerOnly, Count, std::int16_t, float>,
      &sweepBlock<Relaxation, Real, LowerOnly, Count, WideIndex, float>,
      &sweepBlock<Relaxation, Real, LowerOnly, Count, std::int16_t, Rounded>,
      &sweepBlock<Relaxation, Real, LowerOnly, Count, WideIndex, Rounded> };
  }
  template <class Relaxation>
  static constexpr SweepTable of()
  {
    return { { kindsOf<Relaxation, false, 1>(), kindsOf<Relaxation, false, 4>(),
      kindsOf<Relaxation, true, 1>(), kindsOf<Relaxation, true, 4>() } };
  }

  /** Relaxes the nodes of the part once; `lowerOnly`: see Relaxation. */
  void operator()(
    const BlockPart<Real>& part, const PatchRelaxation<Real>* patches, bool lowerOnly) const
  {
    const RowBlock::Header& h = part.header();
    const int kind = (h.weightBytes == sizeof(float) ? 0 : 2) + h.wide;
    const int values = (lowerOnly ? 2 : 0) + (part.stride > 1 ? 1 : 0);
    this->functions[static_cast<std::size_t>(values)][static_cast<std::size_t>(kind)](
      part, patches);
  }

  std::array<Kinds, 4> functions;
};

/** A relaxation as the engine calls it. */
struct CompiledRelaxation
{
  SweepTable<double> finest;
  SweepTable<float> coarse;

  template <class Real>
  const SweepTable<Real>& table() const
  {
    if constexpr (std::is_same_v<Real, double>)
    {
      return this->finest;
    }
    else
    {
      return this->coarse;
    }
  }
};

template <Relaxation R>
inline constexpr CompiledRelaxation compiledRelaxation{ SweepTable<double>::of<R>(),
  SweepTable<float>::of<R>() };

} // namespace smg
