// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/GroupTable.h"

#include "IO/Files/InputFile.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace smg
{
namespace
{

constexpr std::uint32_t NoGroup = UINT32_MAX;
constexpr std::size_t LongestName = 1024;

/** The name as text without control characters. */
std::string cleaned(const std::string& name)
{
  if (name.size() > LongestName)
  {
    throw MeshError("the name of a group has " + std::to_string(name.size()) +
                    " characters, but may have " + std::to_string(LongestName));
  }
  return oneLine(name);
}

} // namespace

GroupSets::GroupSets(std::vector<std::vector<std::uint32_t>> sets)
  : Sets(std::move(sets))
{
  for (std::size_t number = 0; number < this->Sets.size(); ++number)
  {
    this->Members += this->Sets[number].size();
    this->Numbers.emplace(this->Sets[number], static_cast<GroupSet>(number));
  }
}

GroupSet GroupSets::numberOf(std::vector<std::uint32_t> set)
{
  const auto found = this->Numbers.find(set);
  if (found != this->Numbers.end())
  {
    return found->second;
  }
  if (this->Sets.size() > Most || this->Members + set.size() > MostMembers)
  {
    this->IsFull = true;
    return 0;
  }
  const auto number = static_cast<GroupSet>(this->Sets.size());
  this->Members += set.size();
  this->Sets.push_back(set);
  this->Numbers.emplace(std::move(set), number);
  return number;
}

GroupSet GroupSets::join(GroupSet a, GroupSet b)
{
  if (a == b || b == 0)
  {
    return a;
  }
  if (a == 0)
  {
    return b;
  }
  constexpr std::size_t MostJoined = std::size_t(1) << 20;
  if (this->Joined.size() >= MostJoined)
  {
    this->Joined.clear(); // only remembers
  }
  const auto [found, isNew] = this->Joined.try_emplace({ std::min(a, b), std::max(a, b) }, 0);
  if (isNew)
  {
    std::vector<std::uint32_t> set;
    std::ranges::set_union(this->Sets[a], this->Sets[b], std::back_inserter(set));
    found->second = this->numberOf(std::move(set));
  }
  return found->second;
}

std::string GroupSets::overflowNote()
{
  return "The file has more than " + std::to_string(Most) +
         " groups and combinations of them, which is what a mesh has room for, or names of more "
         "than " +
         mebibytes(GroupTable::MostNameBytes) + ": those beyond are left out.";
}

bool GroupTable::fits(std::size_t nameBytes) const
{
  return this->NameBytes + nameBytes <= MostNameBytes;
}

bool GroupTable::hasRoom(std::size_t nameBytes) const
{
  return this->Groups.size() < Most && this->fits(nameBytes);
}

std::uint32_t GroupTable::ofNumber(int dimension, std::int64_t number)
{
  const auto next = static_cast<std::uint32_t>(this->Groups.size());
  const auto [found, isNew] =
    this->ByNumber[static_cast<std::size_t>(dimension)].emplace(number, next);
  if (isNew)
  {
    this->Groups.push_back({ dimension, {}, number });
  }
  return found->second;
}

GroupSet GroupTable::numbered(int dimension, std::int64_t number)
{
  if (this->LastNumber != std::pair(dimension, number))
  {
    this->LastNumber = { dimension, number };
    // One that does not fit is not even listed: labels may be as many as cells.
    const bool fits = this->ByNumber[static_cast<std::size_t>(dimension)].contains(number) ||
                      (!this->IsFull && this->hasRoom(0));
    this->IsFull = this->IsFull || !fits;
    this->LastSet = fits ? this->Sets.numberOf({ this->ofNumber(dimension, number) }) : None;
  }
  return this->LastSet;
}

GroupSet GroupTable::named(int dimension, const std::string& text)
{
  const std::string name = cleaned(text);
  const auto next = static_cast<std::uint32_t>(this->Groups.size());
  auto& names = this->ByName[static_cast<std::size_t>(dimension)];
  const auto found = names.find(name);
  if (found != names.end())
  {
    return this->Sets.numberOf({ found->second });
  }
  if (!this->hasRoom(name.size()))
  {
    this->IsFull = true;
    return None;
  }
  names.emplace(name, next);
  this->NameBytes += name.size();
  this->Groups.push_back({ dimension, name, std::nullopt });
  return this->Sets.numberOf({ next });
}

void GroupTable::setName(int dimension, std::int64_t number, const std::string& text)
{
  const std::string name = cleaned(text);
  if (this->numbered(dimension, number) == None)
  {
    return;
  }
  if (!this->fits(name.size()))
  {
    this->IsFull = true;
  }
  else
  {
    this->NameBytes += name.size();
    const std::uint32_t group = this->ofNumber(dimension, number);
    this->Groups[group].name = name;
    this->ByName[static_cast<std::size_t>(dimension)].emplace(name, group);
  }
}

void GroupTable::include(int dimension, std::int64_t number, const std::string& name)
{
  const GroupSet part = this->numbered(dimension, number), whole = this->named(dimension, name);
  if (part != None && whole != None && this->Inclusions.size() < Most)
  {
    this->Inclusions.emplace(this->Sets.all()[part].front(), this->Sets.all()[whole].front());
  }
}

/** Adds the larger groups of those in a set, and theirs. */
void GroupTable::addWholes(std::vector<std::uint32_t>& set) const
{
  if (this->Inclusions.empty())
  {
    return;
  }
  std::set<std::uint32_t> all(set.begin(), set.end());
  for (std::size_t k = 0; k < set.size(); ++k)
  {
    const auto [begin, end] = this->Inclusions.equal_range(set[k]);
    for (auto at = begin; at != end; ++at)
    {
      if (all.insert(at->second).second)
      {
        set.push_back(at->second);
      }
    }
  }
  set.assign(all.begin(), all.end());
}

MeshGroups GroupTable::finish(CellType cells) const
{
  const int dimension = cornersOf(cells) - 1;
  MeshGroups result;
  std::vector<std::uint32_t> kept(this->Groups.size(), NoGroup);
  for (std::size_t g = 0; g < this->Groups.size(); ++g)
  {
    const Entry& entry = this->Groups[g];
    if (entry.dimension <= dimension)
    {
      kept[g] = static_cast<std::uint32_t>(result.groups.size());
      result.groups.push_back({ entry.name, entry.number,
        entry.dimension == dimension       ? GroupOf::Cells
        : entry.dimension == dimension - 1 ? GroupOf::Facets
                                           : GroupOf::Vertices });
    }
  }
  result.sets = this->Sets.all();
  for (std::vector<std::uint32_t>& set : result.sets)
  {
    this->addWholes(set);
    for (std::uint32_t& group : set)
    {
      group = kept[group];
    }
    std::erase(set, NoGroup);
  }
  return result;
}

} // namespace smg
