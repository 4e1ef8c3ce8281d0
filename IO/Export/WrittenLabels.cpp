// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/WrittenLabels.h"

#include "IO/Files/FileNames.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <string>

namespace smg
{

WrittenLabels::WrittenLabels(PlacedColumns& columns, const MeshFileInfo& info, GroupOf kind,
  std::initializer_list<std::string_view> names)
  : Groups(info.groups)
  , Kind(kind)
  , Label(kind == GroupOf::Vertices ? columns.integerOfVertices(names)
                                    : columns.integerOfElements(names))
  , Sets(kind == GroupOf::Vertices ? columns.integerOfVertices({ VertexGroupsName })
                                   : columns.integerOfElements({ CellGroupsName }))
{
  this->Sets = this->Groups ? this->Sets : -1;
}

void WrittenLabels::write(TextOutput& out, const std::vector<Column>& columns, std::size_t tuple,
  std::string_view otherwise)
{
  if (!this->areGroups())
  {
    out.tuple(columns, this->Label, tuple, otherwise);
    return;
  }
  std::int64_t label = 0;
  std::int64_t count = 0;
  const GroupSet set = columns[static_cast<std::size_t>(this->Sets)].as<GroupSet>()[tuple];
  for (const std::uint32_t group : this->Groups->groupsOf(set, this->Kind))
  {
    if (!this->IsElsewhere || !this->IsElsewhere(this->Groups->groups().groups[group]))
    {
      label = count++ == 0 ? this->Groups->numberOf(group) : label;
    }
  }
  this->InSeveral += count > 1 ? 1 : 0;
  out << ' ' << label;
}

void noteLabels(const MeshFileInfo& info, std::initializer_list<const WrittenLabels*> labels,
  const std::function<bool(const Group&)>& isElsewhere, WriteNotes& notes)
{
  if (!info.groups)
  {
    return;
  }
  const auto hasLabel = [&](const Group& group)
  {
    return group.of == GroupOf::Facets ||
           std::ranges::any_of(labels, [&](const WrittenLabels* written)
             { return written->kind() == group.of && written->areGroups(); });
  };
  const std::string numbers = info.groups->numbersNote(
    [&](const Group& group) { return hasLabel(group) && !isElsewhere(group); });
  if (!numbers.empty())
  {
    notes.push_back(numbers);
  }
  std::string leftOut;
  for (const Group& group : info.groups->groups().groups)
  {
    // Numbers are those of the column, as a rule.
    if (!hasLabel(group) && !isElsewhere(group) && !group.number)
    {
      leftOut += (leftOut.empty() ? "" : ", ") + inQuotes(group.name);
    }
  }
  if (!leftOut.empty())
  {
    notes.push_back(
      "These groups are left out, since a column has the place of their numbers: " + leftOut + '.');
  }
  for (const WrittenLabels* const written : labels)
  {
    const bool areCells = written->kind() == GroupOf::Cells;
    if (const std::int64_t count = written->inSeveral(); count > 0)
    {
      notes.push_back(counted(count, areCells ? "cell is" : "vertex is",
                        areCells ? "cells are" : "vertices are") +
                      " in several groups, of which the file has the first one.");
    }
  }
}

} // namespace smg
