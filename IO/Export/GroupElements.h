// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"
#include "smg/Groups.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace smg
{

/**
 * The facets and vertices of a .vsm file that are in groups, for writers of formats with elements
 * of several dimensions. Counted when it is made, in one reading of their columns; delivered in a
 * second reading, with the numbers of vertices in the file that is written.
 */
class GroupElements
{
public:
  /** `restored`: vertices are numbered as in the original file, else as in the stream. `memory`
   * accounts for the numbers of open vertices, and must outlive this. */
  GroupElements(const std::filesystem::path& vsm, bool restored, Pool& memory);

  const MeshGroups& groups() const { return this->Groups; }
  /** The groups of a set that are of this kind. */
  std::vector<std::uint32_t> groupsOf(GroupSet set, GroupOf kind) const;
  /** How often vertices or facets of this kind are in a group: each counts for each of its groups.
   */
  std::int64_t memberships(GroupOf kind) const;
  /** The number of a group in files where each has one of its own among those of its kind: its own,
   * or one that no other has. */
  std::int64_t numberOf(std::uint32_t group) const { return this->Numbers[group]; }

  using Visit = std::function<void(std::span<const std::int64_t> vertices, GroupSet set)>;
  /** Calls `visit` with the vertices of each facet, or each vertex, that is in a group, in stream
   * order. */
  void forEach(GroupOf kind, const Visit& visit) const;

private:
  std::filesystem::path File;
  bool IsRestored;
  Pool* Memory;
  MeshGroups Groups;
  std::vector<std::int64_t> Numbers;
  std::vector<std::int64_t> OfVertices, OfFacets; ///< how many are in each set
};

} // namespace smg
