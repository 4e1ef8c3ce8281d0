// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace smg
{

/** Finds the place of a node by its tag. Tags are any numbers, mostly 1, 2, 3 ... */
class GmshNodes
{
public:
  /** Notes the tag of the next node; false if there is one with this tag already. */
  bool add(std::int64_t tag)
  {
    const std::int64_t place = this->Count++;
    if (this->Others.empty() && this->distance(tag) == static_cast<std::uint64_t>(place))
    {
      return true;
    }
    if (place == 0)
    {
      this->First = tag;
      return true;
    }
    if (this->Others.empty())
    {
      this->Consecutive = place;
    }
    return !this->isConsecutive(tag) && this->Others.emplace(tag, place).second;
  }

  /** The place of the node, from 0, or -1. */
  std::int64_t find(std::int64_t tag) const
  {
    if (this->isConsecutive(tag))
    {
      return tag - this->First;
    }
    const auto entry = this->Others.find(tag);
    return entry == this->Others.end() ? -1 : entry->second;
  }

  std::int64_t count() const { return this->Count; }

private:
  bool isConsecutive(std::int64_t tag) const
  {
    const std::int64_t end = this->Others.empty() ? this->Count : this->Consecutive;
    return this->distance(tag) < static_cast<std::uint64_t>(end);
  }

  /** From the first tag, without overflow. */
  std::uint64_t distance(std::int64_t tag) const
  {
    return static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(this->First);
  }

  std::int64_t Count = 0;
  std::int64_t First = 1;       ///< tag of the first node
  std::int64_t Consecutive = 0; ///< nodes from the first on whose tags count up by one
  std::unordered_map<std::int64_t, std::int64_t> Others;
};

} // namespace smg
