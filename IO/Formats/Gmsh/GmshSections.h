// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Gmsh/GmshInput.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Solver/Memory/Pool.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

namespace smg
{

/** A type of elements: its dimension and corners, and its nodes, corners first. */
struct GmshElementType
{
  std::uint8_t dimension = 0, corners = 0;
  std::uint16_t nodes = 0; ///< 0: unknown type
  bool operator==(const GmshElementType&) const = default;
};

/** The element type of this number in a .msh file. */
GmshElementType gmshElementType(std::int64_t type);

/**
 * The tags of the elements: physical groups become groups of the mesh, with their names, and the
 * cell column `PhysicalTag` (the first one, 0: none); the entity of the geometry is the column
 * `GeometricalTag`. In version 2 each element has its own tags; from version 4 on it has those of
 * its entity. A column without information (no group, or entity 1, for all elements) is omitted.
 */
class GmshTags
{
public:
  static constexpr std::int64_t NoGroup = 0, FirstEntity = 1;

  explicit GmshTags(RawMeshBuilder& builder);

  /** Reads the section $PhysicalNames, after its first line. */
  void readNames(GmshInput& input);
  /** Reads the section $Entities of version 4, after its first line. */
  void readEntities(GmshInput& input);
  /** Reads the section $PartitionedEntities of version 4, after its first line: the parts into
   * which entities were cut, with the physical groups of these. */
  void readPartitionedEntities(GmshInput& input);

  /** Physical groups. */
  struct Physicals
  {
    std::int64_t first = NoGroup;
    GroupSet set = GroupTable::None;
  };
  /** Those of an entity. */
  Physicals groupsOf(std::int64_t dimension, std::int64_t entity) const;

  /** That of an element which has a group of its own; 0: none. */
  Physicals groupOf(int dimension, std::int64_t group)
  {
    return { group,
      group == NoGroup ? GroupTable::None : this->Builder.groups().numbered(dimension, group) };
  }

  /** Appends the tags of the next element. */
  void add(const Physicals& groups, int dimension, std::int64_t entity)
  {
    this->HasSolids = this->HasSolids || dimension == 3;
    this->Builder.setGroups(groups.set);
    this->Physical.add(groups.first, dimension);
    this->Geometrical.add(entity, dimension);
  }
  /** After the last element. Notes that a geometry of volumes has no cells of these. */
  void finish();

private:
  void readEntity(GmshInput& input, std::size_t dimension, bool isPartitioned);
  void addGroup(std::size_t dimension, std::int64_t entity, std::int64_t group);

  RawMeshBuilder& Builder;
  LabelColumn Physical, Geometrical;
  std::int64_t Volumes = 0; ///< of the geometry, as far as the file says
  bool HasSolids = false;   ///< among the elements
  Reservation GroupMemory;
  std::array<std::map<std::int64_t, Physicals>, 4> Groups; ///< by dimension and entity
};

} // namespace smg
