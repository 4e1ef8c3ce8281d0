// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Cycle/GaussSeidel.h"
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Setup/Patches.h"

#include <cstdint>

namespace smg
{

/** b_k + sum_j w_kj x_j of node k of a block, with x taken as zero for node k and for all nodes
 * from `limit` on. Members of the patch below `limit` are zero at that time. */
template <class Vectors, class Real, class Arrays>
typename Vectors::Vector lowerResidual(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
  std::int64_t limit, std::int64_t stride, const Real* x, const Real* b)
{
  const BlockRange row = entriesOf(h, a, k);
  auto sum = Vectors::load(b + k * stride);
  for (std::int64_t e = row.begin; e < row.end && k + a.delta[e] < limit; ++e)
  {
    sum += static_cast<Real>(a.weight[e]) * Vectors::load(x + (k + a.delta[e]) * stride);
  }
  return sum;
}

/** x += A_bb^-1 (b - A x) on the `size` nodes of a patch, given their residuals and the inverse
 * of the matrix on the patch. x points to the last member; the others are at `distance`.
 * LowerOnly: x of the last member was zero and is not read. */
template <bool LowerOnly, class Vectors, class Real>
void correctPatch(int size, const double* distance, const double* inverse,
  const typename Vectors::Vector* residual, std::int64_t stride, Real* x)
{
  for (int a = 0; a < size; ++a)
  {
    typename Vectors::Vector sum{};
    for (int k = 0; k < size; ++k)
    {
      sum += static_cast<Real>(inverse[PatchMatrix::place(a, k)]) * residual[k];
    }
    Real* at = x + (a + 1 < size ? static_cast<std::int64_t>(distance[a]) : 0) * stride;
    if (!LowerOnly || a + 1 < size)
    {
      sum += Vectors::load(at);
    }
    Vectors::store(at, sum);
  }
}

/**
 * A sweep of a Relaxation over nodes of a level, a kernel for LevelWindow::forColumns(). Ordinary
 * nodes are relaxed one by one. With `patches` the nodes of a patch are relaxed together, at its
 * last member. Only the first sweep of each half of a V-cycle does so: behind a sweep that relaxes
 * node by node the next stage waits for neighbours only, not for the ends of patches, so the window
 * is shorter.
 *
 * LowerOnly: x is zero above each node, as in the first sweep on a coarse level, and is not read
 * there.
 */
template <class Relaxation, class Real, bool LowerOnly>
class Sweep
{
public:
  using State = typename LevelWindow<Real>::State;

  Sweep(const LevelWindow<Real>& window, State& state, bool patches)
    : Window(window)
    , Values(state)
    , Patches(patches)
  {
  }

  template <class Arrays, class Vectors>
  void operator()(const Arrays& a, Vectors, const BlockPart<Real>& part) const
  {
    const RowBlock::Header& h = part.header;
    // A constant for one column.
    const std::int64_t stride = Vectors::count == 1 ? 1 : part.stride;
    for (NodeRuns runs(h, a, part.nodes); runs.next();)
    {
      const RowBlock::Special* special = runs.special();
      if (!special)
      {
        Relaxation::template sweep<LowerOnly, Vectors>(h, a, runs.nodes(), stride, part.x, part.b);
      }
      else if (special->size == 1 || !this->Patches)
      {
        // Alone, by its precise weights if it has some.
        visitSpecial<Real>(h, a, *special,
          [&](const auto& row) {
            Relaxation::template sweep<LowerOnly, Vectors>(
              h, row, runs.nodes(), stride, part.x, part.b);
          });
      }
      else if (special->size > 1)
      {
        this->relaxPatch<Vectors>(a, *special, part);
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

private:
  /** Relaxes the patch that ends at `node`. Its members may lie in earlier blocks of the window. */
  template <class Vectors, class Arrays>
  void relaxPatch(const Arrays& a, const RowBlock::Special& node, const BlockPart<Real>& part) const
  {
    const std::int64_t last = part.header.first + node.node;
    const double* distance = a.value + node.value;
    typename Vectors::Vector residual[PatchMatrix::Most];
    for (int k = 0; k + 1 < node.size; ++k)
    {
      this->Window.visitRow(last + static_cast<std::int64_t>(distance[k]),
        [&](const auto& h, const auto& rows, std::int64_t own)
        { residual[k] = this->residualOf<Vectors>(h, rows, own, last, part); });
    }
    residual[node.size - 1] = this->residualOf<Vectors>(part.header, a, node.node, last, part);
    // The values of the patch are the distances of the other members, then the inverse.
    correctPatch<LowerOnly, Vectors>(node.size, distance, distance + node.size - 1, residual,
      part.stride, this->Values.x.at(last) + part.lane);
  }

  /** The residual of node k of a block, a member of the patch that ends at node `last`. */
  template <class Vectors, class Arrays>
  typename Vectors::Vector residualOf(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
    std::int64_t last, const BlockPart<Real>& part) const
  {
    const Real* x = this->Values.x.at(h.first) + part.lane;
    const Real* b = this->Values.b.at(h.first) + part.lane;
    typename Vectors::Vector residual;
    visitSpecial<Real>(h, a, *specialFrom(h, a, k),
      [&](const auto& row)
      {
        if constexpr (LowerOnly)
        {
          residual = lowerResidual<Vectors>(h, row, k, last - h.first, part.stride, x, b);
        }
        else
        {
          residual = ResidualOfDifferences::of<Vectors>(h, row, k, part.stride, x, b);
        }
      });
    return residual;
  }

  const LevelWindow<Real>& Window;
  State& Values;
  bool Patches;
};

} // namespace smg
