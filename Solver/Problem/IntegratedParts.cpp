// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/IntegratedParts.h"

#include "Solver/Problem/Selection.h"

#include <algorithm>

namespace smg
{

IntegratedParts::IntegratedParts(
  const std::vector<std::string>& wanted, const MeshGroups& groups, const Fail& fail)
{
  if (wanted.empty())
  {
    return;
  }
  this->ofSet.resize(groups.sets.size());
  if (std::ranges::find(wanted, "*") != wanted.end())
  {
    this->names.emplace_back("all");
    std::ranges::for_each(this->ofSet, [](auto& parts) { parts.push_back(0); });
  }
  constexpr std::uint32_t None = UINT32_MAX;
  std::vector<std::uint32_t> partOf(groups.groups.size(), None);
  for (std::size_t k = 0; k < wanted.size(); ++k)
  {
    const std::vector<std::uint32_t> found = groups.find(wanted[k], GroupOf::Cells);
    if (found.empty() && wanted[k] != "*")
    {
      fail("integrals[" + std::to_string(k) + ']', whyNoGroup(wanted[k], groups));
    }
    for (const std::uint32_t group : found)
    {
      if (partOf[group] == None)
      {
        partOf[group] = static_cast<std::uint32_t>(this->names.size());
        this->names.push_back(groups.groups[group].label());
      }
    }
  }
  for (std::size_t set = 0; set < groups.sets.size(); ++set)
  {
    for (const std::uint32_t group : groups.sets[set])
    {
      if (partOf[group] != None)
      {
        this->ofSet[set].push_back(partOf[group]);
      }
    }
  }
}

} // namespace smg
