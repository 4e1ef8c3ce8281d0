// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/SoughtIds.h"

#include <algorithm>

namespace smg
{

SoughtIds::SoughtIds(const std::vector<std::int64_t>& ids)
  : Size(static_cast<std::int64_t>(ids.size()))
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    this->Sorted.emplace_back(ids[i], static_cast<std::int64_t>(i));
  }
  std::sort(this->Sorted.begin(), this->Sorted.end());
  const auto end = std::unique(this->Sorted.begin(), this->Sorted.end(),
    [](const auto& a, const auto& b) { return a.first == b.first; });
  this->Sorted.erase(end, this->Sorted.end());
}

std::int64_t SoughtIds::numberOf(std::int64_t id) const
{
  const auto found =
    std::lower_bound(this->Sorted.begin(), this->Sorted.end(), std::pair(id, std::int64_t(0)));
  return found != this->Sorted.end() && found->first == id ? found->second : -1;
}

std::int64_t SoughtIds::firstMissing(const std::vector<char>& isFound) const
{
  for (const auto& [id, number] : this->Sorted)
  {
    if (number >= static_cast<std::int64_t>(isFound.size()) || !isFound[number])
    {
      return id;
    }
  }
  return -1;
}

} // namespace smg
