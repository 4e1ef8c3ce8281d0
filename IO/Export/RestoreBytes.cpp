// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoreBytes.h"

#include "IO/Mesh/RowBytes.h"

#include <algorithm>

namespace smg
{

namespace
{

/** The files of a RowSort: none for rows that fit into its memory with the keys and their places.
 */
std::int64_t sortBytes(std::int64_t rows, std::int64_t bytes, std::int64_t memory)
{
  constexpr std::int64_t KeyBytes = 8, PlaceBytes = 8;
  return rows * (KeyBytes + PlaceBytes + bytes) > memory ? rows * (KeyBytes + bytes) : 0;
}

} // namespace

std::int64_t restoreBytes(const StreamInfo& mesh, std::int64_t memory, std::string_view suffix)
{
  constexpr std::int64_t Number = sizeof(std::uint32_t);
  const std::int64_t corners = mesh.cells * cornersOf(mesh.cellType);
  const std::int64_t element =
    rowBytes(mesh.cellColumns, cornersOf(mesh.cellType) * Number); // with the columns
  // As RestoredMesh: vertices and elements are sorted; the stream's corners and the pairs of
  // numbers give way to the elements with their sizes.
  const std::int64_t sorted =
    sortBytes(mesh.vertices, rowBytes(mesh.vertexColumns, positionBytes(mesh)), memory / 4) +
    sortBytes(mesh.cells, element, memory / 3);
  const std::int64_t numbers = mesh.vertices * 2 * Number + corners * Number;
  const std::int64_t elements = mesh.cells * (Number + element);
  // As TrianglePositions: the corners are sorted by vertices, then with coordinates by triangles.
  constexpr std::int64_t PositionBytes = 3 * sizeof(double);
  const std::int64_t triangles = suffix == ".stl" ? sortBytes(corners, 2 * Number, memory / 3) +
                                                      sortBytes(corners, PositionBytes, memory / 3)
                                                  : 0;
  return sorted + std::max(numbers, elements + triangles);
}

} // namespace smg
