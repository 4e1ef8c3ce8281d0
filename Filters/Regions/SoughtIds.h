// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** Ids that are sought, with their numbers in a list. */
class SoughtIds
{
public:
  SoughtIds() = default;
  explicit SoughtIds(const std::vector<std::int64_t>& ids);

  /** The number of the id, the first of several; -1: it is not sought. */
  std::int64_t numberOf(std::int64_t id) const;
  std::int64_t size() const { return this->Size; }

  /** The first id of which `isFound`, by numbers, says that it was not found; -1: none. */
  std::int64_t firstMissing(const std::vector<char>& isFound) const;

private:
  std::vector<std::pair<std::int64_t, std::int64_t>> Sorted;
  std::int64_t Size = 0;
};

} // namespace smg
