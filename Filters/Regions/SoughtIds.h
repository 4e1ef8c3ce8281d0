// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** A list of ids to search for, with their indices in the list. */
class SoughtIds
{
public:
  SoughtIds() = default;
  explicit SoughtIds(const std::vector<std::int64_t>& ids);

  /** The index of the id, the first of several; -1 if it is not in the list. */
  std::int64_t numberOf(std::int64_t id) const;
  std::int64_t size() const { return this->Size; }

  /** The first id that `isFound`, by index, does not mark; -1 if there is none. */
  std::int64_t firstMissing(const std::vector<char>& isFound) const;

private:
  std::vector<std::pair<std::int64_t, std::int64_t>> Sorted;
  std::int64_t Size = 0;
};

} // namespace smg
