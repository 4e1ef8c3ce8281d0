// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Cycle/Sweep.h"
#include "Solver/Multigrid/Setup/Patches.h"

// Patches are solved by the inverses of their matrices, which blocks contain. The residuals of all
// members come first, in the order of the members.

namespace smg
{
namespace
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

/** The residual of node k of a block, a member of the patch that ends at node `last`. */
template <bool LowerOnly, class Vectors, class Real, class Arrays>
typename Vectors::Vector memberResidual(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
  std::int64_t last, std::int64_t stride, const Real* x, const Real* b)
{
  typename Vectors::Vector residual{};
  visitSpecial<Real>(h, a, *specialFrom(h, a, k),
    [&](const auto& row)
    {
      if constexpr (LowerOnly)
      {
        residual = lowerResidual<Vectors>(h, row, k, last - h.first, stride, x, b);
      }
      else
      {
        residual = ResidualOfDifferences::of<Vectors>(h, row, k, stride, x, b);
      }
    });
  return residual;
}

} // namespace

template <class Real>
template <bool LowerOnly, class Vectors>
void PatchRelaxation<Real>::relax(const BlockPart<Real>& part, const RowBlock::Special& node) const
{
  const std::int64_t last = part.header().first + node.node;
  part.block.template visit<Real>(
    [&](const auto& a)
    {
      // The values of the patch are the distances of the other members, then the inverse.
      const double* distance = a.value + node.value;
      typename Vectors::Vector residual[PatchMatrix::Most];
      for (int m = 0; m < node.size; ++m)
      {
        const bool isLast = m + 1 == node.size;
        this->Window->visitRow(isLast ? last : last + static_cast<std::int64_t>(distance[m]),
          [&](const RowBlock::Header& h, const auto& rows, std::int64_t k)
          {
            residual[m] = memberResidual<LowerOnly, Vectors>(h, rows, k, last, part.stride,
              this->X->at(h.first) + part.lane, this->B->at(h.first) + part.lane);
          });
      }
      correctPatch<LowerOnly, Vectors>(node.size, distance, distance + node.size - 1, residual,
        part.stride, this->X->at(last) + part.lane);
    });
}

template <class Real>
void PatchRelaxation<Real>::operator()(
  const BlockPart<Real>& part, const RowBlock::Special& node, bool lowerOnly) const
{
  using One = SimdPack<Real, 1>;
  using Four = SimdPack<Real, 4>;
  if (part.stride == 1)
  {
    lowerOnly ? this->relax<true, One>(part, node) : this->relax<false, One>(part, node);
  }
  else
  {
    lowerOnly ? this->relax<true, Four>(part, node) : this->relax<false, Four>(part, node);
  }
}

template class PatchRelaxation<double>;
template class PatchRelaxation<float>;

} // namespace smg
