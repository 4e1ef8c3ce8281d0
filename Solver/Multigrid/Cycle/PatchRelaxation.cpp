// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/LevelWindow.h"
#include "Solver/Multigrid/Cycle/Residual.h"
#include "Solver/Multigrid/Cycle/Sweep.h"
#include "Solver/Multigrid/Setup/OverlappingPatches.h"

#include <optional>

// Patches are solved by the inverses of their matrices, which blocks contain. The residuals of all
// members come first, in the order of the members.

namespace smg
{
namespace
{

/** The residual of node k of a block, with x taken as zero for all nodes from `limit` on. */
template <class Vectors, class Real, class Arrays>
typename Vectors::Vector residualBelow(const RowBlock::Header& h, const Arrays& a, std::int64_t k,
  std::int64_t limit, std::int64_t stride, const Real* x, const Real* b)
{
  const RowView row(h, a, k);
  const Real* xk = x + k * stride;
  const auto sum =
    row.template plusProductsBelow<Vectors>(limit - k, Vectors::load(b + k * stride), xk, stride);
  // In an overlapping patch it may have a value before its own patch is complete.
  return k < limit ? sum - static_cast<Real>(row.diagonal) * Vectors::load(xk) : sum;
}

/** x += A_bb^-1 (b - A x) on the `size` nodes of a patch, given their residuals and the inverse
 * of the matrix on the patch. x points to the last member; the others are at `distance`.
 * `isLastZero`: x of the last member was zero and is not read. */
template <class Vectors, class Real>
void correctPatch(bool isLastZero, int size, const double* distance, const double* inverse,
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
    if (!isLastZero || a + 1 < size)
    {
      sum += Vectors::load(at);
    }
    Vectors::store(at, sum);
  }
}

} // namespace

template <class Real>
template <class Vectors>
void PatchRelaxation<Real>::relax(const BlockPart<Real>& part, std::int64_t last, int size,
  const double* values, std::optional<std::int64_t> zeroFrom) const
{
  // The values of a patch are the distances of the other members, then the inverse.
  typename Vectors::Vector residual[OverlappingPatches::Patch::Most];
  for (int m = 0; m < size; ++m)
  {
    const bool isLast = m + 1 == size;
    this->Window->visitRow(isLast ? last : last + static_cast<std::int64_t>(values[m]),
      [&](const RowBlock::Header& h, const auto& rows, std::int64_t k)
      {
        const Real* x = this->X->at(h.first) + part.lane;
        const Real* b = this->B->at(h.first) + part.lane;
        const auto measure = [&](const auto& row)
        {
          residual[m] =
            zeroFrom ? residualBelow<Vectors>(h, row, k, *zeroFrom - h.first, part.stride, x, b)
                     : ResidualOfDifferences::of<Vectors>(h, row, k, part.stride, x, b);
        };
        // Members of overlapping patches may be ordinary nodes.
        const RowBlock::Special* special = specialFrom(h, rows, k);
        special < rows.special + h.specials && special->node == k
          ? visitSpecial<Real>(h, rows, *special, measure)
          : measure(rows);
      });
  }
  correctPatch<Vectors>(zeroFrom && *zeroFrom <= last, size, values, values + size - 1, residual,
    part.stride, this->X->at(last) + part.lane);
}

template <class Real>
template <class Vectors>
void PatchRelaxation<Real>::relaxOverlapping(
  const BlockPart<Real>& part, const RowBlock::Special& node, SweepKind sweep) const
{
  const std::int64_t last = part.header().first + node.node;
  const auto zeroFrom = sweep == SweepKind::LowerOnly ? std::optional(last + 1) : std::nullopt;
  const double* first = part.block.values() + node.overlapping;
  const auto patches = static_cast<int>(*first++);
  for (int k = 0; k < patches; ++k)
  {
    // Hardly ever more than one: the walk to the last one of them costs nothing.
    const double* values = first;
    for (int before = sweep == SweepKind::Backward ? patches - 1 - k : k; before > 0; --before)
    {
      values += 1 + RowBlock::Special::valuesOf(static_cast<int>(*values));
    }
    this->relax<Vectors>(part, last, static_cast<int>(*values), values + 1, zeroFrom);
  }
}

template <class Real>
void PatchRelaxation<Real>::operator()(
  const BlockPart<Real>& part, const RowBlock::Special& node, bool lowerOnly) const
{
  const std::int64_t last = part.header().first + node.node;
  const double* values = part.block.values() + node.value;
  const auto zeroFrom = lowerOnly ? std::optional(last) : std::nullopt;
  part.stride == 1 ? this->relax<SimdPack<Real, 1>>(part, last, node.size, values, zeroFrom)
                   : this->relax<SimdPack<Real, 4>>(part, last, node.size, values, zeroFrom);
}

template <class Real>
void PatchRelaxation<Real>::relaxOverlapping(
  const BlockPart<Real>& part, const RowBlock::Special& node, SweepKind sweep) const
{
  part.stride == 1 ? this->relaxOverlapping<SimdPack<Real, 1>>(part, node, sweep)
                   : this->relaxOverlapping<SimdPack<Real, 4>>(part, node, sweep);
}

template class PatchRelaxation<double>;
template class PatchRelaxation<float>;

} // namespace smg
