// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/LabelGroups.h"
#include "IO/Import/ListedElements.h"
#include "IO/Import/RawMeshBuilder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace smg
{

/** A section of elements, and their corners. */
struct MeditSection
{
  std::string_view keyword;
  int dimension;
  std::size_t corners;
  std::int32_t code; ///< of the keyword in binary files
};
inline constexpr std::array<MeditSection, 7> MeditSections{ { { "Edges", 1, 2, 5 },
  { "Triangles", 2, 3, 6 }, { "Quadrilaterals", 2, 4, 7 }, { "Tetrahedra", 3, 4, 8 },
  { "Hexahedra", 3, 8, 10 }, { "Prisms", 3, 6, 9 }, { "Pyramids", 3, 5, 49 } } };

/** A section of the numbers of vertices or of elements of a section that are special. */
struct MeditList
{
  std::string_view keyword;
  const char* group;      ///< that it is in the mesh
  std::string_view items; ///< whose numbers it has; vertices: none of MeditSections
  std::int32_t code;
};
inline constexpr std::array<MeditList, 6> MeditLists{ { { "Corners", "corners", "", 13 },
  { "Ridges", "ridges", "Edges", 14 }, { "RequiredVertices", "required", "", 15 },
  { "RequiredEdges", "required", "Edges", 16 },
  { "RequiredTriangles", "required", "Triangles", 17 },
  { "RequiredQuadrilaterals", "required", "Quadrilaterals", 18 } } };

/**
 * The groups of a Medit file: references other than 0, by their numbers, and what sections of lists
 * name. Edges are no elements of the mesh, but members of groups.
 */
class MeditGroups
{
public:
  explicit MeditGroups(RawMeshBuilder& builder)
    : Builder(builder)
    , Edges(builder.workspace())
    , Surfaces(builder.workspace())
  {
  }

  /** To be called before the elements of a section. */
  void beginSection(const MeditSection& section, std::int64_t count);
  /** Passes an element to the builder. */
  void add(
    const MeditSection& section, std::span<const std::int64_t> corners, std::int64_t reference);
  /** Takes a number, from 1, of a list; throws MeshError if there is no such thing. */
  void list(const MeditList& list, std::int64_t number);
  /** After the last section. */
  void finish();

private:
  /** Elements of a section that follow each other. */
  struct Stretch
  {
    std::string_view keyword;
    std::int64_t first, count;
  };

  RawMeshBuilder& Builder;
  std::vector<Stretch> Stretches;
  ListedElements Edges, Surfaces;
  std::int64_t EdgeCount = 0;
};

} // namespace smg
