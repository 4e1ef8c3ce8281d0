// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Ring.h"
#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "smg/Export.h"

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

// A sweep over a block of a level. A relaxation is a template; for the engine it becomes a table of
// functions, one for each kind of block and of values, so that the engine is compiled once. A call
// treats a block, and in it the compiler sees the types of all arrays.

namespace smg
{

template <class Real>
class LevelWindow;

/** A sweep forwards, in the order of the stream; the same with x taken as zero above each node (see
 * Relaxation); or backwards, the transpose of a sweep forwards, for which all nodes must be in
 * memory. */
enum class SweepKind
{
  Forward,
  LowerOnly,
  Backward
};

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
  /** The same with the overlapping patches whose last member is `node`, one after the other. */
  void relaxOverlapping(
    const BlockPart<Real>& part, const RowBlock::Special& node, SweepKind sweep) const;

private:
  /** Relaxes a patch of `size` nodes; `values`: see RowBlock::Special. x counts as zero from the
   * node `zeroFrom` on, where there is one, and is not read there. */
  template <class Vectors>
  void relax(const BlockPart<Real>& part, std::int64_t last, int size, const double* values,
    std::optional<std::int64_t> zeroFrom) const;
  template <class Vectors>
  void relaxOverlapping(
    const BlockPart<Real>& part, const RowBlock::Special& node, SweepKind sweep) const;

  const LevelWindow<Real>* Window;
  const Ring<Real>*X, *B;
};

extern template class PatchRelaxation<double>;
extern template class PatchRelaxation<float>;

/** Relaxes a special node: alone, by its precise weights if it has some; or, with `patches`, with
 * its patch if it is the last member of that. */
template <class Relaxation, bool LowerOnly, class Vectors, class Real, class Arrays>
void relaxOwn(const BlockPart<Real>& part, const Arrays& a, const RowBlock::Special& node,
  std::int64_t stride, const PatchRelaxation<Real>* patches)
{
  const RowBlock::Header& h = part.header();
  if (node.size == 1 || !patches)
  {
    const BlockRange alone{ node.node, node.node + 1 };
    visitSpecial<Real>(h, a, node,
      [&](const auto& row)
      {
        Relaxation::template sweep<LowerOnly, Vectors>(
          h, row, alone, stride, part.x, static_cast<const Real*>(part.b));
      });
  }
  else if (node.size > 1)
  {
    (*patches)(part, node, LowerOnly);
  }
  else if (LowerOnly)
  {
    // It waits for the last member. x is not initialised in this sweep, but the last member and
    // nodes between read it as zero.
    const typename Vectors::Vector zero{};
    Vectors::store(part.x + node.node * stride, zero);
  }
}

/** Relaxes a special node, and then, with `patches`, the overlapping patches that end there; or the
 * other way round in a sweep backwards. */
template <class Relaxation, SweepKind Kind, class Vectors, class Real, class Arrays>
void relaxSpecial(const BlockPart<Real>& part, const Arrays& a, const RowBlock::Special& node,
  std::int64_t stride, const PatchRelaxation<Real>* patches)
{
  const auto relaxOverlapping = [&]
  {
    if (patches && node.overlapping >= 0)
    {
      patches->relaxOverlapping(part, node, Kind);
    }
  };
  if constexpr (Kind == SweepKind::Backward)
  {
    relaxOverlapping();
  }
  relaxOwn<Relaxation, Kind == SweepKind::LowerOnly, Vectors>(part, a, node, stride, patches);
  if constexpr (Kind != SweepKind::Backward)
  {
    relaxOverlapping();
  }
}

/** Relaxes the nodes of a part in descending order, one at a time, since a Relaxation ascends. */
template <class Relaxation, class Vectors, class Real, class Arrays>
void sweepBackward(const BlockPart<Real>& part, const Arrays& a, std::int64_t stride,
  const PatchRelaxation<Real>* patches)
{
  const RowBlock::Header& h = part.header();
  const RowBlock::Special* special = specialFrom(h, a, part.nodes.end);
  for (std::int64_t k = part.nodes.end - 1; k >= part.nodes.begin; --k)
  {
    if (special != a.special && (special - 1)->node == k)
    {
      --special;
      relaxSpecial<Relaxation, SweepKind::Backward, Vectors>(part, a, *special, stride, patches);
    }
    else
    {
      Relaxation::template sweep<false, Vectors>(
        h, a, BlockRange{ k, k + 1 }, stride, part.x, static_cast<const Real*>(part.b));
    }
  }
}

/**
 * A sweep of a Relaxation over a part of a block. Ordinary nodes are relaxed one by one. With
 * `patches` the nodes of a patch are relaxed together, at its last member. Only the first sweep of
 * each half of a V-cycle does so: behind a sweep that relaxes node by node the next stage waits for
 * neighbours only, not for the ends of patches, so the window is shorter.
 */
template <class Relaxation, class Real, SweepKind Kind, int Count, class Index, class Weight>
void sweepBlock(BlockPart<Real> part, const PatchRelaxation<Real>* patches)
{
  using Vectors = SimdPack<Real, Count>;
  constexpr bool LowerOnly = Kind == SweepKind::LowerOnly;
  const RowBlock::Header& h = part.header();
  const auto a = part.block.template arrays<Index, Weight>();
  const std::int64_t stride = Count == 1 ? 1 : part.stride; // a constant for one column
  for (; part.lane < stride; part.lane += Count, part.x += Count, part.b += Count)
  {
    if constexpr (Kind == SweepKind::Backward)
    {
      sweepBackward<Relaxation, Vectors>(part, a, stride, patches);
      continue;
    }
    for (NodeRuns runs(h, a, part.nodes); runs.next();)
    {
      const RowBlock::Special* special = runs.special();
      if (!special)
      {
        Relaxation::template sweep<LowerOnly, Vectors>(
          h, a, runs.nodes(), stride, part.x, static_cast<const Real*>(part.b));
      }
      else
      {
        relaxSpecial<Relaxation, Kind, Vectors>(part, a, *special, stride, patches);
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

  template <class Relaxation, SweepKind Kind, int Count>
  static constexpr Kinds kindsOf()
  {
    // There are no rounded weights on the finest level.
    using Rounded = std::conditional_t<std::is_same_v<Real, double>, float, BFloat16>;
    return { &sweepBlock<Relaxation, Real, Kind, Count, std::int16_t, float>,
      &sweepBlock<Relaxation, Real, Kind, Count, WideIndex, float>,
      &sweepBlock<Relaxation, Real, Kind, Count, std::int16_t, Rounded>,
      &sweepBlock<Relaxation, Real, Kind, Count, WideIndex, Rounded> };
  }
  template <class Relaxation>
  static constexpr SweepTable of()
  {
    using enum SweepKind;
    return { { kindsOf<Relaxation, Forward, 1>(), kindsOf<Relaxation, Forward, 4>(),
      kindsOf<Relaxation, LowerOnly, 1>(), kindsOf<Relaxation, LowerOnly, 4>(),
      kindsOf<Relaxation, Backward, 1>(), kindsOf<Relaxation, Backward, 4>() } };
  }

  /** Relaxes the nodes of the part once. */
  void operator()(
    const BlockPart<Real>& part, const PatchRelaxation<Real>* patches, SweepKind sweep) const
  {
    const RowBlock::Header& h = part.header();
    const int kind = (h.weightBytes == sizeof(float) ? 0 : 2) + h.wide;
    const int values = 2 * static_cast<int>(sweep) + (part.stride > 1 ? 1 : 0);
    this->functions[static_cast<std::size_t>(values)][static_cast<std::size_t>(kind)](
      part, patches);
  }

  std::array<Kinds, 6> functions;
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
