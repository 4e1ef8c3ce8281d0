// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Formats/Gmsh/GmshInput.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "Solver/Memory/Pool.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

namespace smg
{

/** A type of elements: its dimension and corners, and its nodes, corners first. */
struct GmshElementType
{
  std::uint8_t dimension = 0, corners = 0;
  std::uint16_t nodes = 0; ///< 0: unknown type
};

/** The element type of this number in a .msh file. */
GmshElementType gmshElementType(std::int64_t type);

/**
 * The tags of the nodes, to which elements refer: any numbers, usually 1, 2, 3 ... Consecutive tags
 * are not stored; others are sorted out of core, and the elements have tags as corners until a
 * Relabelling replaces these.
 */
class GmshNodes
{
public:
  explicit GmshNodes(Workspace& workspace)
    : Space(workspace)
  {
  }

  /** Adds the tag of the next node. */
  void add(std::int64_t tag)
  {
    if (!this->Tags && tag >= this->First &&
        this->distance(tag) == static_cast<std::uint64_t>(this->Count))
    {
      ++this->Count;
      return;
    }
    this->addOther(tag);
  }
  std::int64_t count() const { return this->Count; }

  /** To be called after the last node. Throws MeshError if two nodes have the same tag, or the
   * range of the tags exceeds 32 bits. */
  void finish();

  /** After finish(): passes what the tags are as corners to the builder. */
  void numberCorners(RawMeshBuilder& builder);

private:
  struct Tag
  {
    std::int64_t tag;
    std::int64_t vertex;
    bool operator<(const Tag& other) const
    {
      return this->tag != other.tag ? this->tag < other.tag : this->vertex < other.vertex;
    }
  };

  /** From the first tag, without overflow. */
  std::uint64_t distance(std::int64_t tag) const
  {
    return static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(this->First);
  }
  void addOther(std::int64_t tag);
  void number();

  Workspace& Space;
  std::int64_t Count = 0;
  std::int64_t First = 1; ///< tag of the first node; after finish() the least tag
  std::int64_t Least = std::numeric_limits<std::int64_t>::max();
  std::int64_t Largest = std::numeric_limits<std::int64_t>::min();
  std::uint64_t Range = 0; ///< tags from First to the largest one
  std::optional<ExternalSort<Tag>> Tags;
  std::optional<Relabelling> Numbers;
};

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

  /** Appends the tags of the next element, which has a group of its own; 0: none. */
  void add(int dimension, std::int64_t group, std::int64_t entity)
  {
    this->add({ group, group == NoGroup ? GroupTable::None
                                        : this->Builder.groups().numbered(dimension, group) },
      entity);
  }
  /** Appends those of an element of an entity. */
  void add(const Physicals& groups, std::int64_t entity)
  {
    this->Builder.setGroups(groups.set);
    this->Physical.add(groups.first);
    this->Geometrical.add(entity);
  }
  /** After the last element. */
  void finish()
  {
    this->Physical.finish();
    this->Geometrical.finish();
  }

private:
  void readEntity(GmshInput& input, std::size_t dimension, bool isPartitioned);
  void addGroup(std::size_t dimension, std::int64_t entity, std::int64_t group);

  RawMeshBuilder& Builder;
  LabelColumn Physical, Geometrical;
  Reservation GroupMemory;
  std::array<std::map<std::int64_t, Physicals>, 4> Groups; ///< by dimension and entity
};

} // namespace smg
