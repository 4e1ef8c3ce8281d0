// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "smg/Groups.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

class VsmReader;

/**
 * The facets, vertices and cells of a .vsm file that are in groups, for writers of formats with
 * elements of several dimensions. Counted when it is made, in one reading of their columns;
 * delivered in a second reading, with the numbers of vertices in the file that is written.
 */
class GroupElements
{
public:
  /** `restored`: vertices and cells are numbered as in the original file, else as in the stream.
   * The mesh, and `space`, which accounts for the numbers of open vertices, must outlive this. */
  GroupElements(const VsmReader& mesh, bool restored, Workspace& space);

  const MeshGroups& groups() const { return this->Groups; }
  /** The groups of a set that are of this kind, ascending. */
  std::vector<std::uint32_t> groupsOf(GroupSet set, GroupOf kind) const;
  /** How often vertices, facets or cells are in a group: each counts for each of its groups. */
  std::int64_t memberships(GroupOf kind) const;
  /** How many are in any group. */
  std::int64_t grouped(GroupOf kind) const;
  /** The same of this group alone. */
  std::int64_t members(std::uint32_t group) const { return this->Members[group]; }
  /** The number of a group in files where each has one of its own among those of its kind: its own,
   * or one that no other has. */
  std::int64_t numberOf(std::uint32_t group) const { return this->Numbers[group]; }

  /** For formats in which groups have only numbers: "Groups have only numbers in the file: 'inlet'
   * is 3." of those that `isWritten` tells; empty: they have no names. */
  std::string numbersNote(const std::function<bool(const Group&)>& isWritten) const;

  using Visit =
    std::function<void(std::span<const std::int64_t> vertices, GroupSet set, std::int64_t element)>;
  /** Calls `visit` with the vertices of each facet, or each vertex, that is in a group, in stream
   * order. A facet faces out of its cell, whose number is that of an element of the file; vertices
   * have none. */
  void forEach(GroupOf kind, const Visit& visit) const;

private:
  const VsmReader* Mesh;
  bool IsRestored;
  Workspace* Space;
  MeshGroups Groups;
  std::vector<std::int64_t> Numbers;
  std::vector<std::int64_t> Members;               ///< of each group
  std::array<std::vector<std::int64_t>, 3> Counts; ///< by GroupOf: how many are in each set
};

} // namespace smg
