// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/OpenFaces.h"

#include <algorithm>

namespace smg
{

std::size_t OpenFaces::Hash::operator()(const Face& face) const
{
  std::uint64_t hash = 0;
  for (const std::int64_t corner : face)
  {
    hash = (hash ^ static_cast<std::uint64_t>(corner)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

void OpenFaces::add(std::span<const std::int64_t, 4> corners)
{
  constexpr int faces[4][3] = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 0, 2, 1 } };
  for (const auto& [a, b, c] : faces)
  {
    const Face outward{ corners[a], corners[b], corners[c] };
    Face sorted = outward;
    std::sort(sorted.begin(), sorted.end());
    const auto [entry, isNew] = this->Open.try_emplace(sorted, outward);
    if (!isNew)
    {
      this->Open.erase(entry);
    }
  }
}

void OpenFaces::closeBelow(std::int64_t finalized, const std::function<void(const Face&)>& outer)
{
  for (auto entry = this->Open.begin(); entry != this->Open.end();)
  {
    if (entry->first[0] < finalized)
    {
      outer(entry->second);
      entry = this->Open.erase(entry);
    }
    else
    {
      ++entry;
    }
  }
}

} // namespace smg
