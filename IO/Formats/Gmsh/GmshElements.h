// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** The shapes of the elements of a Gmsh file, of any order. */
enum class GmshShape : std::uint8_t
{
  None, ///< a point or a line: not a cell of a mesh
  Triangle,
  Quadrilateral,
  Tetrahedron,
  Hexahedron,
  Prism,
  Pyramid
};

/** A type of elements: its shape, and its nodes, corners first. */
struct GmshElementType
{
  GmshShape shape = GmshShape::None;
  std::uint16_t nodes = 0; ///< 0: unknown type

  std::size_t corners() const;
};

/** The element type of this number in a .msh file. */
GmshElementType gmshElementType(std::int64_t type);

/** Passes an element to the builder; `corners` are type.corners() vertices in Gmsh's order. */
void addGmshElement(
  RawMeshBuilder& builder, GmshElementType type, std::span<const std::int64_t> corners);

} // namespace smg
