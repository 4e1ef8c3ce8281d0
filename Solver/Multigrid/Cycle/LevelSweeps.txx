// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/Level.h"

#include <algorithm>
#include <type_traits>

// The kernels of a level, applied to ranges of nodes that the stages choose. One column is computed
// as such, several in groups of four lanes (SimdPack); the stride is 1 or a multiple of four.
// Special nodes (RowBlock::Special) interrupt the ranges: rows with weights in double precision,
// and patches.

namespace smg
{

/** One sweep over `nodes`, which are relaxed one by one. */
template <bool LowerOnly, class Relaxation, class Real, class Arrays>
void relaxNodes(
  const RowBlock::Header& h, const Arrays& a, BlockRange nodes, int stride, Real* x, const Real* b)
{
  if (stride == 1)
  {
    Relaxation::template sweep<LowerOnly, SimdPack<Real, 1>>(h, a, nodes, 1, x, b);
  }
  for (int lane = 0; lane + 3 < stride; lane += 4)
  {
    Relaxation::template sweep<LowerOnly, SimdPack<Real, 4>>(
      h, a, nodes, stride, x + lane, b + lane);
  }
}

template <class Real, class Relaxation>
template <bool LowerOnly>
void Level<Real, Relaxation>::sweep(
  std::int64_t begin, std::int64_t end, State& state, bool patches)
{
  const int stride = this->Window.stride();
  this->Window.forRange(begin, end, state,
    [&](const auto& h, const auto& a, BlockRange range, Real* x, Real* b)
    {
      visitNodes(
        h, a, range,
        [&](BlockRange nodes) { relaxNodes<LowerOnly, Relaxation>(h, a, nodes, stride, x, b); },
        [&](const RowBlock::Special& node)
        { this->relaxSpecial<LowerOnly>(h, a, node, state, patches); });
    });
}

/** A node outside patches, or in a sweep that ignores them, is relaxed alone, by its precise
 * weights if it has some. A node of a patch waits for the last member, which relaxes all of
 * them. */
template <class Real, class Relaxation>
template <bool LowerOnly, class Arrays>
void Level<Real, Relaxation>::relaxSpecial(const RowBlock::Header& h, const Arrays& a,
  const RowBlock::Special& node, State& state, bool patches)
{
  const int stride = this->Window.stride();
  Real* x = state.x.at(h.first);
  if (node.size == 1 || !patches)
  {
    const Real* b = state.b.at(h.first);
    visitSpecial<Real>(h, a, node,
      [&](const auto& arrays) {
        relaxNodes<LowerOnly, Relaxation>(h, arrays, { node.node, node.node + 1 }, stride, x, b);
      });
    return;
  }
  if (node.size == 0)
  {
    // x is not initialised in this sweep, but the last member and nodes between read it as zero.
    if (LowerOnly)
    {
      std::fill_n(x + node.node * static_cast<std::int64_t>(stride), stride, Real{});
    }
    return;
  }
  if (stride == 1)
  {
    this->relaxPatch<LowerOnly, One>(h, a, node, state, 0);
  }
  for (int lane = 0; lane + 3 < stride; lane += 4)
  {
    this->relaxPatch<LowerOnly, Four>(h, a, node, state, lane);
  }
}

/** Relaxes the patch that ends at `node`, for the columns from `lane` on. Its members may lie in
 * earlier blocks of the window. */
template <class Real, class Relaxation>
template <bool LowerOnly, class Vectors, class Arrays>
void Level<Real, Relaxation>::relaxPatch(
  const RowBlock::Header& h, const Arrays& a, const RowBlock::Special& node, State& state, int lane)
{
  const int stride = this->Window.stride();
  const std::int64_t last = h.first + node.node;
  const double* distance = a.value + node.value;
  typename Vectors::Vector residual[PatchMatrix::Most];
  const auto findResidual = [&](const auto& header, const auto& rows, std::int64_t k, int member)
  {
    visitSpecial<Real>(header, rows, specialOf(header, rows, k),
      [&](const auto& arrays)
      {
        const Real* x = state.x.at(header.first) + lane;
        const Real* b = state.b.at(header.first) + lane;
        if constexpr (LowerOnly)
        {
          residual[member] =
            lowerResidual<Vectors>(header, arrays, k, last - header.first, stride, x, b);
        }
        else
        {
          residual[member] = ResidualOfDifferences::of<Vectors>(header, arrays, k, stride, x, b);
        }
      });
  };
  for (int k = 0; k + 1 < node.size; ++k)
  {
    this->Window.visitRow(last + static_cast<std::int64_t>(distance[k]),
      [&](const auto& header, const auto& rows, std::int64_t own)
      { findResidual(header, rows, own, k); });
  }
  // The values of the patch are the distances of the other members, then the inverse.
  findResidual(h, a, node.node, node.size - 1);
  correctPatch<LowerOnly, Vectors>(
    node.size, distance, distance + node.size - 1, residual, stride, state.x.at(last) + lane);
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::prolongTo(std::int64_t begin, std::int64_t end)
{
  const int stride = this->Window.stride();
  this->Window.forRange(begin, end, this->Window.up(),
    [&](const auto& h, const auto& a, BlockRange nodes, Real* x, Real*)
    {
      // A ring is contiguous around any item in memory: parents of the block are relative to this
      // one.
      const float* coarse = this->Coarse->window().x().at(h.parentBase);
      if (stride == 1)
      {
        prolong<One, SimdPack<float, 1>>(h, a, nodes, 1, x, coarse, this->Unscale);
      }
      for (int lane = 0; lane + 3 < stride; lane += 4)
      {
        prolong<Four, SimdPack<float, 4>>(
          h, a, nodes, stride, x + lane, coarse + lane, this->Unscale);
      }
    });
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::residualAll(Real* residual)
{
  const int stride = this->Window.stride();
  this->Window.forRange(0, this->Window.nodes(), this->Window.down(),
    [&](const auto& h, const auto& a, BlockRange nodes, const Real* x, const Real* b)
    {
      for (std::int64_t k = nodes.begin; k < nodes.end; ++k)
      {
        Real* values = residual + (h.first + k) * stride;
        if (stride == 1)
        {
          One::store(values, PlainResidual::of<One>(h, a, k, 1, x, b));
        }
        for (int lane = 0; lane + 3 < stride; lane += 4)
        {
          Four::store(values + lane, PlainResidual::of<Four>(h, a, k, stride, x + lane, b + lane));
        }
      }
    });
}

template <class Real, class Relaxation>
void Level<Real, Relaxation>::restrictTo(std::int64_t end)
{
  const int stride = this->Window.stride();
  this->Window.forRange(this->Core ? 0 : std::int64_t(this->At.restricted), end,
    this->Window.down(),
    [&](const auto& h, const auto& a, BlockRange range, Real* x, Real* b)
    {
      float* coarse = this->Coarse->window().b().at(h.parentBase);
      Real* squares = this->Squares.data();
      Real* terms = squares + stride;
      // Special nodes of the finest level get the residual by differences, all others the plain
      // one.
      const auto restrictNodes = [&]<class Residual>(Residual, const auto& arrays, BlockRange nodes)
      {
        const auto restrictLanes = [&]<int Count>(std::integral_constant<int, Count>, int lane)
        {
          using Vectors = SimdPack<Real, Count>;
          ResidualKeeper<Vectors> kept(this->History, h.first, lane);
          restrictResidual<Residual, Vectors, SimdPack<float, Count>>(h, arrays, nodes, stride,
            x + lane, b + lane, coarse + lane, this->Scale, squares + lane, terms + lane,
            [&](std::int64_t k, const typename Vectors::Vector& r)
            {
              kept(k, r);
              this->template addEnergy<Vectors>(h, arrays, k, x + lane, b + lane, r, lane);
            });
        };
        if (stride == 1)
        {
          restrictLanes(std::integral_constant<int, 1>(), 0);
        }
        for (int lane = 0; lane + 3 < stride; lane += 4)
        {
          restrictLanes(std::integral_constant<int, 4>(), lane);
        }
      };
      if constexpr (!std::is_same_v<Real, double>)
      {
        restrictNodes(PlainResidual{}, a, range);
      }
      else
      {
        visitNodes(
          h, a, range, [&](BlockRange nodes) { restrictNodes(PlainResidual{}, a, nodes); },
          [&](const RowBlock::Special& node)
          {
            visitSpecial<Real>(h, a, node,
              [&](const auto& rows) {
                restrictNodes(ResidualOfDifferences{}, rows, { node.node, node.node + 1 });
              });
          });
      }
    });
}

/** Adds node k of a block, whose residual is r, to the energy of the iterate, if that is wanted.
 * Nodes without entries have prescribed values and do not count. */
template <class Real, class Relaxation>
template <class Vectors, class Arrays>
void Level<Real, Relaxation>::addEnergy(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
  const Real* x, const Real* b, const typename Vectors::Vector& r, int lane)
{
  if constexpr (std::is_same_v<Real, double>)
  {
    if (!this->Energy)
    {
      return;
    }
    const BlockRange row = entriesOf(h, a, k);
    if (row.begin < row.end)
    {
      const std::int64_t at = k * this->Window.stride();
      this->Energy->template add<Vectors>(x + at, b + at, r, RowBlock::alphaOf(h, a, k), lane);
    }
  }
}

} // namespace smg
