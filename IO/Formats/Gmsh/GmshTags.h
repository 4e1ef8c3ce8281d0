// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Gmsh/GmshInput.h"
#include "IO/Import/LabelColumn.h"
#include "Solver/Memory/Reservation.h"

#include <array>
#include <cstdint>
#include <map>

namespace smg
{

/**
 * The tags of the elements as the cell columns `PhysicalTag` (the physical group, 0: none) and
 * `GeometricalTag` (the entity of the geometry). In version 2 each element has its own tags; in
 * version 4.1 it has those of its entity, with only the first physical group. A column without
 * information (no group, or entity 1, for all elements) is omitted.
 */
class GmshTags
{
public:
  static constexpr std::int64_t NoGroup = 0, FirstEntity = 1;

  explicit GmshTags(RawMeshBuilder& builder);

  /** Reads the section $Entities of version 4.1, after its first line. */
  void readEntities(GmshInput& input);
  /** The physical group of an entity. */
  std::int64_t groupOf(std::int64_t dimension, std::int64_t entity) const;

  /** Appends the tags of the next element. */
  void add(std::int64_t group, std::int64_t entity);
  /** After the last element. */
  void finish();

private:
  void setGroup(std::size_t dimension, std::int64_t entity, std::int64_t group);

  LabelColumn Physical, Geometrical;
  Reservation GroupMemory;
  std::array<std::map<std::int64_t, std::int64_t>, 4> Groups; ///< by dimension and entity
};

} // namespace smg
