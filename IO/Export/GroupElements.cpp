// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/GroupElements.h"

#include "IO/Files/FileNames.h"
#include "Solver/Problem/OpenValues.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
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

/** A stream with the column of this kind first and, if they are wanted, the original numbers of
 * vertices and, if known, of cells last. */
std::unique_ptr<MeshSource> groupStream(const VsmReader& reader, GroupOf kind, bool withNumbers)
{
  std::vector<std::string> ofVertices, ofCells;
  (kind == GroupOf::Vertices ? ofVertices : ofCells).emplace_back(MeshGroups::columnOf(kind));
  if (withNumbers)
  {
    ofVertices.emplace_back(OriginalIdName);
    if (kind == GroupOf::Facets && findColumn(reader.info().cellColumns, OriginalCellIdSpec) >= 0)
    {
      ofCells.emplace_back(OriginalCellIdName);
    }
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

/** Own numbers stay, unless another group of the kind has it, as those of points and of edges,
 * which are both of vertices; these groups and those of a name alone get the next ones. Groups of a
 * number alone are one if it is the same. */
std::vector<std::int64_t> uniqueNumbers(const std::vector<Group>& groups)
{
  std::map<std::pair<GroupOf, std::int64_t>, std::string> taken; // by the group of this label
  for (const bool isNamed : { false, true })
  {
    for (const Group& group : groups)
    {
      if (group.number && group.name.empty() != isNamed)
      {
        taken.try_emplace({ group.of, *group.number }, group.label());
      }
    }
  }
  std::vector<std::int64_t> numbers;
  std::array<std::int64_t, 3> next{ 1, 1, 1 };
  for (const Group& group : groups)
  {
    const bool isOwn = group.number && taken.at({ group.of, *group.number }) == group.label();
    std::int64_t& free = next[std::size_t(group.of)];
    while (!isOwn && taken.contains({ group.of, free }))
    {
      ++free;
    }
    numbers.push_back(isOwn ? *group.number : free++);
  }
  return numbers;
}

} // namespace

GroupElements::GroupElements(const VsmReader& mesh, bool restored, Workspace& space)
  : Mesh(&mesh)
  , IsRestored(restored)
  , Space(&space)
  , Groups(mesh.info().groups)
  , Numbers(uniqueNumbers(this->Groups.groups))
  , Members(this->Groups.groups.size())
  , Counts{ countSets(mesh, GroupOf::Vertices), countSets(mesh, GroupOf::Facets),
    countSets(mesh, GroupOf::Cells) }
{
  for (std::size_t set = 1; set < this->Groups.sets.size(); ++set)
  {
    for (const std::uint32_t group : this->Groups.sets[set])
    {
      this->Members[group] += this->Counts[std::size_t(this->Groups.groups[group].of)][set];
    }
  }
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
  const std::vector<std::int64_t>& counts = this->Counts[std::size_t(kind)];
  std::int64_t sum = 0;
  for (std::size_t set = 1; set < counts.size(); ++set)
  {
    sum += counts[set] * std::ssize(this->groupsOf(static_cast<GroupSet>(set), kind));
  }
  return sum;
}

std::int64_t GroupElements::grouped(GroupOf kind) const
{
  const std::vector<std::int64_t>& counts = this->Counts[std::size_t(kind)];
  std::int64_t sum = 0;
  for (std::size_t set = 1; set < counts.size(); ++set)
  {
    sum += this->groupsOf(static_cast<GroupSet>(set), kind).empty() ? 0 : counts[set];
  }
  return sum;
}

std::string GroupElements::numbersNote(const std::function<bool(const Group&)>& isWritten) const
{
  constexpr std::size_t Most = 20;
  std::string names;
  std::size_t count = 0;
  for (std::size_t g = 0; g < this->Groups.groups.size(); ++g)
  {
    const Group& group = this->Groups.groups[g];
    if (!group.name.empty() && isWritten(group) && ++count <= Most)
    {
      names += (names.empty() ? "" : ", ") + inQuotes(group.name) + " is " +
               std::to_string(this->Numbers[g]);
    }
  }
  return names.empty()
           ? ""
           : "Groups have only numbers in the file: " + names + (count > Most ? " ..." : ".");
}

void GroupElements::forEach(GroupOf kind, const Visit& visit) const
{
  if (this->memberships(kind) == 0)
  {
    return;
  }
  const auto source = groupStream(*this->Mesh, kind, this->IsRestored);
  const auto corners = static_cast<std::size_t>(cornersOf(this->Mesh->info().cellType));
  OpenValues<std::int64_t> numbers(this->Space->pool());
  std::array<std::int64_t, 4> vertices{};
  for (MeshBlock block; source->next(block);)
  {
    const std::span<std::int64_t> ofBlock = numbers.startBlock(block);
    for (std::size_t v = 0; v < ofBlock.size(); ++v)
    {
      ofBlock[v] = this->IsRestored ? block.vertexColumns.back().as<std::int64_t>()[v]
                                    : block.firstVertex + static_cast<std::int64_t>(v);
    }
    if (kind == GroupOf::Vertices)
    {
      const std::span<const GroupSet> sets =
        std::as_const(block.vertexColumns.front()).as<GroupSet>();
      for (std::size_t v = 0; v < sets.size(); ++v)
      {
        sets[v] == 0 ? void() : visit(ofBlock.subspan(v, 1), sets[v], -1);
      }
      continue;
    }
    const std::span<const GroupSet> sets = std::as_const(block.cellColumns.front()).as<GroupSet>();
    const bool knowsCells = block.cellColumns.size() > 1;
    for (std::size_t i = 0; i < sets.size(); ++i)
    {
      if (sets[i] == 0)
      {
        continue;
      }
      const std::size_t cell = i / corners, opposite = i % corners;
      std::size_t count = 0;
      for (std::size_t k = 0; k < corners; ++k)
      {
        if (k != opposite)
        {
          vertices[count++] = *numbers.at(block.corners[cell * corners + k]);
        }
      }
      if (opposite % 2 != 0)
      {
        std::swap(vertices[count - 2], vertices[count - 1]); // to face outwards
      }
      visit(std::span(vertices).first(count), sets[i],
        knowsCells ? std::as_const(block.cellColumns.back()).as<std::int64_t>()[cell]
                   : block.firstCell + static_cast<std::int64_t>(cell));
    }
  }
}

} // namespace smg
