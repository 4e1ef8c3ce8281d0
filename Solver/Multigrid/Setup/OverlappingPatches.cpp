// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/OverlappingPatches.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

// In a cluster of slivers of solids, what an exact solve on a patch leaves is an error around it
// that no coarse function has. A solve on the patch and a part of its ring removes it. The
// strongest couplings are what the ring is cut by: a dozen nodes do nearly what the whole ring
// does.

namespace smg
{
namespace
{

/** A node beside a patch, and the square of its strongest coupling to a member. */
struct Neighbour
{
  double coupling;
  std::int64_t node;
};

/** Whether the weights of a row of the patch cancel beyond OverlappingPatches::Cancelling. */
bool isAmongTheWorst(const LevelRows& rows, const Patch& patch)
{
  for (int k = 0; k < patch.size; ++k)
  {
    const std::int64_t i = patch.member(k);
    if (static_cast<double>(rows.magnitudes(i)) > OverlappingPatches::Cancelling * rows.diagonal(i))
    {
      return true;
    }
  }
  return false;
}

/** The nodes beside the patch from its first node to `last`, the most strongly coupled ones first.
 */
std::vector<Neighbour> neighboursOf(const LevelRows& rows, const Patch& patch, std::int64_t last)
{
  std::vector<Neighbour> couplings;
  for (int k = 0; k < patch.size; ++k)
  {
    const std::int64_t i = patch.member(k);
    const double diagonal = rows.diagonal(i);
    for (const RowEntry& entry : rows.row(i))
    {
      const std::int64_t j = i + entry.delta();
      const std::int32_t* end = patch.offset + patch.size;
      if (j > patch.first && j <= last && !std::binary_search(patch.offset, end, j - patch.first))
      {
        const double weight = entry.weight();
        couplings.push_back({ weight * weight / (diagonal * rows.diagonal(j)), j });
      }
    }
  }
  std::ranges::sort(couplings, [](const Neighbour& a, const Neighbour& b)
    { return a.node != b.node ? a.node < b.node : a.coupling > b.coupling; });
  const auto repeated = std::ranges::unique(couplings, {}, &Neighbour::node);
  couplings.erase(repeated.begin(), repeated.end());
  std::ranges::stable_sort(couplings, std::greater(), &Neighbour::coupling);
  return couplings;
}

} // namespace

std::int64_t OverlappingPatches::append(const LevelRows& rows, const smg::Patch& core, int rings)
{
  if (!isAmongTheWorst(rows, core))
  {
    return 0;
  }
  std::vector<std::int64_t> members;
  for (int k = 0; k < core.size; ++k)
  {
    members.push_back(core.member(k));
  }
  const auto most = static_cast<std::size_t>(Patch::Most);
  for (const Neighbour& neighbour : neighboursOf(rows, core, lastOf(rows, core.first, rings)))
  {
    if (members.size() == most)
    {
      break;
    }
    members.push_back(neighbour.node);
  }
  std::ranges::sort(members);
  const std::int64_t number = this->Found.end();
  this->Found.extendRaw(number + 1);
  Patch& patch = this->Found[number];
  patch.setMembers(members);
  for (const std::int64_t i : members)
  {
    std::int32_t& last = this->LastWith[i];
    last = std::max(last, static_cast<std::int32_t>(members.back() - i));
  }
  patch.link =
    std::exchange(this->EndingAt[members.back()], static_cast<std::uint32_t>(number) + 1);
  const int size = Matrix::entriesOf(patch.size);
  std::copy_n(matrixOf(rows, patch).entry, size, this->Triangles.open(size));
  this->Triangles.close(size);
  return size;
}

void OverlappingPatches::release(std::int64_t node)
{
  std::int64_t number = this->Found.first();
  while (number < this->Found.end() && this->Found[number].last() < node)
  {
    ++number;
  }
  this->Found.release(number);
  this->Triangles.release(number);
  this->LastWith.release(node);
  this->EndingAt.release(node);
}

} // namespace smg
