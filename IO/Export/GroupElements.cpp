// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/GroupElements.h"

#include "Solver/Problem/OpenValues.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace smg
{
namespace
{

bool hasColumn(const StreamInfo& info, GroupOf kind)
{
  const auto& columns = kind == GroupOf::Vertices ? info.vertexColumns : info.cellColumns;
  return findColumn(columns, MeshGroups::columnSpec(kind, cornersOf(info.cellType))) >= 0;
}

/** A stream with the column of this kind, and the numbers of the vertices if they are wanted. */
std::unique_ptr<MeshSource> groupStream(const VsmReader& reader, GroupOf kind, bool withNumbers)
{
  std::vector<std::string> ofVertices, ofCells;
  (kind == GroupOf::Vertices ? ofVertices : ofCells).emplace_back(MeshGroups::columnOf(kind));
  if (withNumbers)
  {
    ofVertices.emplace_back(OriginalIdName);
  }
  return reader.source(ofVertices, ofCells);
}

std::vector<std::int64_t> countSets(const VsmReader& reader, GroupOf kind)
{
  std::vector<std::int64_t> counts(reader.info().groups.sets.size());
  if (!hasColumn(reader.info(), kind))
  {
    return counts;
  }
  const auto source = groupStream(reader, kind, false);
  for (MeshBlock block; source->next(block);)
  {
    const Column& column =
      kind == GroupOf::Vertices ? block.vertexColumns.front() : block.cellColumns.front();
    for (const GroupSet set : column.as<GroupSet>())
    {
      counts[set < counts.size() ? set : 0] += 1;
    }
  }
  return counts;
}

/** Own numbers stay; groups of a name alone get the next ones. */
std::vector<std::int64_t> uniqueNumbers(const std::vector<Group>& groups)
{
  std::set<std::pair<GroupOf, std::int64_t>> taken;
  for (const Group& group : groups)
  {
    if (group.number)
    {
      taken.emplace(group.of, *group.number);
    }
  }
  std::vector<std::int64_t> numbers;
  std::array<std::int64_t, 3> next{ 1, 1, 1 };
  for (const Group& group : groups)
  {
    std::int64_t& free = next[std::size_t(group.of)];
    while (!group.number && taken.contains({ group.of, free }))
    {
      ++free;
    }
    numbers.push_back(group.number ? *group.number : free++);
  }
  return numbers;
}

} // namespace

GroupElements::GroupElements(const std::filesystem::path& vsm, bool restored, Pool& memory)
  : File(vsm)
  , IsRestored(restored)
  , Memory(&memory)
{
  const VsmReader reader(vsm);
  this->Groups = reader.info().groups;
  this->Numbers = uniqueNumbers(this->Groups.groups);
  this->OfVertices = countSets(reader, GroupOf::Vertices);
  this->OfFacets = countSets(reader, GroupOf::Facets);
}

std::vector<std::uint32_t> GroupElements::groupsOf(GroupSet set, GroupOf kind) const
{
  std::vector<std::uint32_t> found;
  if (set < this->Groups.sets.size())
  {
    std::ranges::copy_if(this->Groups.sets[set], std::back_inserter(found),
      [&](std::uint32_t group) { return this->Groups.groups[group].of == kind; });
  }
  return found;
}

std::int64_t GroupElements::memberships(GroupOf kind) const
{
  const auto& counts = kind == GroupOf::Vertices ? this->OfVertices : this->OfFacets;
  std::int64_t sum = 0;
  for (std::size_t set = 1; set < counts.size(); ++set)
  {
    sum += counts[set] * std::ssize(this->groupsOf(static_cast<GroupSet>(set), kind));
  }
  return sum;
}

void GroupElements::forEach(GroupOf kind, const Visit& visit) const
{
  if (this->memberships(kind) == 0)
  {
    return;
  }
  const VsmReader reader(this->File);
  const auto source = groupStream(reader, kind, this->IsRestored);
  const auto corners = static_cast<std::size_t>(cornersOf(reader.info().cellType));
  OpenValues<std::int64_t> numbers(*this->Memory);
  std::array<std::int64_t, 4> vertices{};
  for (MeshBlock block; source->next(block);)
  {
    const std::span<std::int64_t> ofBlock = numbers.startBlock(block);
    for (std::size_t v = 0; v < ofBlock.size(); ++v)
    {
      ofBlock[v] = this->IsRestored ? block.vertexColumns.back().as<std::int64_t>()[v]
                                    : block.firstVertex + static_cast<std::int64_t>(v);
    }
    const Column& column =
      kind == GroupOf::Vertices ? block.vertexColumns.front() : block.cellColumns.front();
    const std::span<const GroupSet> sets = std::as_const(column).as<GroupSet>();
    for (std::size_t i = 0; i < sets.size(); ++i)
    {
      if (sets[i] == 0)
      {
        continue;
      }
      std::size_t count = 0;
      if (kind == GroupOf::Vertices)
      {
        vertices[count++] = ofBlock[i];
      }
      for (std::size_t k = 0; kind == GroupOf::Facets && k < corners; ++k)
      {
        if (k != i % corners)
        {
          vertices[count++] = *numbers.at(block.corners[i / corners * corners + k]);
        }
      }
      visit(std::span(vertices).first(count), sets[i]);
    }
  }
}

} // namespace smg
