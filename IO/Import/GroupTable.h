// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Groups.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** Sets of groups by numbers, with which columns name them; see MeshGroups::sets. */
class GroupSets
{
public:
  /** The most sets of any group. */
  static constexpr std::size_t Most = 65535;
  /** The most groups in all sets together. */
  static constexpr std::size_t MostMembers = std::size_t(1) << 22;

  explicit GroupSets(std::vector<std::vector<std::uint32_t>> sets = { {} });

  /** The number of a set, ascending indices of groups. 0 if there are too many sets. */
  GroupSet numberOf(std::vector<std::uint32_t> set);
  /** The set of all groups of both. */
  GroupSet join(GroupSet a, GroupSet b);

  const std::vector<std::vector<std::uint32_t>>& all() const { return this->Sets; }
  /** Whether there were too many. */
  bool overflowed() const { return this->IsFull; }
  /** A sentence on that. */
  static std::string overflowNote();

private:
  std::vector<std::vector<std::uint32_t>> Sets;
  std::size_t Members = 0; ///< of all sets
  std::map<std::vector<std::uint32_t>, GroupSet> Numbers;
  std::map<std::pair<GroupSet, GroupSet>, GroupSet> Joined;
  bool IsFull = false;
};

/**
 * The groups of a file while it is parsed, by the dimension of their elements: 0 of points, 1 of
 * lines, 2 of surfaces, 3 of volumes. What they are in the mesh, vertices, facets or cells, depends
 * on the cells, which may come last.
 */
class GroupTable
{
public:
  /** No group. */
  static constexpr GroupSet None = 0;
  /** The most groups. */
  static constexpr std::size_t Most = GroupSets::Most;
  /** The most bytes of all names: groups are in memory. */
  static constexpr std::size_t MostNameBytes = std::size_t(16) << 20;
  static constexpr int Dimensions = 4;

  /** The set of the group of this number alone, which is made if need be. */
  GroupSet numbered(int dimension, std::int64_t number);
  /** The set of the group of this name alone; of several of the name, the first. */
  GroupSet named(int dimension, const std::string& name);
  /** Gives the group of this number its name. Throws MeshError if that is too long. */
  void setName(int dimension, std::int64_t number, const std::string& name);
  /** All that is in the group of this number is in the one of this name, too. */
  void include(int dimension, std::int64_t number, const std::string& name);
  /** The set of all groups of both. */
  GroupSet join(GroupSet a, GroupSet b) { return this->Sets.join(a, b); }

  bool empty() const { return this->Groups.empty(); }
  /** The groups as those of a mesh with cells of this type, where the numbers of the sets are the
   * same. Those of higher dimensions than the cells are left out. */
  MeshGroups finish(CellType cells) const;
  /** Whether there were too many groups or sets. */
  bool overflowed() const { return this->IsFull || this->Sets.overflowed(); }

private:
  struct Entry
  {
    int dimension;
    std::string name;
    std::optional<std::int64_t> number;
  };

  bool fits(std::size_t nameBytes) const;
  bool hasRoom(std::size_t nameBytes) const;
  std::uint32_t ofNumber(int dimension, std::int64_t number);
  void addWholes(std::vector<std::uint32_t>& set) const;

  std::vector<Entry> Groups;
  GroupSets Sets;
  std::size_t NameBytes = 0;
  std::multimap<std::uint32_t, std::uint32_t> Inclusions; ///< a group and a larger one
  std::array<std::map<std::int64_t, std::uint32_t>, Dimensions> ByNumber;
  std::array<std::map<std::string, std::uint32_t>, Dimensions> ByName;
  /** The group asked for last, whose elements usually follow each other. */
  std::pair<int, std::int64_t> LastNumber{ -1, 0 };
  GroupSet LastSet = None;
  bool IsFull = false; ///< whether any was one too many
};

} // namespace smg
