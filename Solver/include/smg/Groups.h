// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** What a group of a mesh consists of. */
enum class GroupOf : std::uint8_t
{
  Vertices, ///< vertices
  Facets,   ///< edges of triangles or faces of tetrahedra, on the boundary or in the interior
  Cells     ///< triangles of a surface, tetrahedra of a volume
};

/** "vertices", "facets" or "cells". */
constexpr const char* nameOf(GroupOf kind)
{
  return kind == GroupOf::Vertices ? "vertices" : kind == GroupOf::Facets ? "facets" : "cells";
}

/** A set of vertices, facets or cells that a mesher has named: a physical group, a set, a label. */
struct Group
{
  std::string name;                   ///< empty: it has a number only
  std::optional<std::int64_t> number; ///< in the mesher; none: it has a name only
  GroupOf of = GroupOf::Cells;        ///< what it consists of

  /** The name, or the number if there is none. */
  std::string label() const
  {
    return this->name.empty() && this->number ? std::to_string(*this->number) : this->name;
  }
  /** Whether all is equal. */
  bool operator==(const Group&) const = default;
};

/** Name of the column (uint16) of the vertices with the set of groups that each is in. */
inline constexpr const char* VertexGroupsName = "VertexGroups";
/** The same of the cells for their facets, a component each: component k belongs to the facet
 * opposite to corner k. Of the two cells of an interior facet, one has it. */
inline constexpr const char* FacetGroupsName = "FacetGroups";
/** The same for the cells themselves. */
inline constexpr const char* CellGroupsName = "CellGroups";
/** The type of these columns. */
using GroupSet = std::uint16_t;

/** Whether a column of this name holds sets of groups. */
constexpr bool isGroupColumn(std::string_view name)
{
  return name == VertexGroupsName || name == FacetGroupsName || name == CellGroupsName;
}

/**
 * The groups of a mesh. An entity may be in several groups: the columns VertexGroups, FacetGroups
 * and CellGroups have one number for each, of a set of groups.
 */
struct SMG_EXPORT MeshGroups
{
  std::vector<Group> groups; ///< all groups, of vertices, facets and cells
  /** For each set the indices of its groups in `groups`, ascending; set 0 is empty, and stands for
   * no group. */
  std::vector<std::vector<std::uint32_t>> sets{ {} };

  /** Whether there are none. */
  bool empty() const { return this->groups.empty(); }
  /** The name of the column that has the sets of this kind. */
  static const char* columnOf(GroupOf kind);
  /** The specification of that column; of facets for cells of this many corners. */
  static ColumnSpec columnSpec(GroupOf kind, int corners);
  /** Whether a column with the name of one of groups is that of a mesh whose cells have this many
   * corners: facets of a surface that was cut out of a solid still have the sets of the solid. */
  static bool isOfMesh(const ColumnSpec& column, bool ofVertices, int corners);

  /**
   * The groups of a kind that `wanted` names: the group of that name or, if there is none, of that
   * number; `*` stands for any characters, so that several groups may be meant.
   * @return indices in `groups`; empty: no group of the kind is called so
   */
  std::vector<std::uint32_t> find(const std::string& wanted, GroupOf kind) const;
  /** For each set, 1 if it has any of these groups, else 0. */
  std::vector<std::uint8_t> setsWith(std::span<const std::uint32_t> wanted) const;
  /** The labels of all groups, those that resemble `wanted` first; as a list for messages, of at
   * most ten. */
  std::string listFor(const std::string& wanted) const;

  /** Whether all is equal. */
  bool operator==(const MeshGroups&) const = default;
};

} // namespace smg
