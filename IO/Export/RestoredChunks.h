// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The properties of a restored mesh before its vertices and elements are read. */
struct RestoredInfo
{
  CellType cellType = CellType::Triangle;
  /** Whether positions have double precision; otherwise they were single precision numbers. */
  bool doublePositions = true;
  std::int64_t vertices = 0; ///< including isolated ones
  std::int64_t isolated = 0;
  std::int64_t cells = 0;          ///< triangles or tetrahedra of the stream
  std::int64_t elements = 0;       ///< the restored polygons or tetrahedra
  std::int64_t quadrilaterals = 0; ///< elements that are polygons of four corners
  std::int64_t corners = 0;        ///< of all elements
  std::int64_t mostCorners = 0;    ///< of an element
  std::vector<ColumnSpec> vertexColumns;
  std::vector<ColumnSpec> elementColumns;
};

/** Consecutive vertices of a restored mesh. */
struct RestoredVertices
{
  std::int64_t first = 0;
  std::vector<double> positions; ///< x, y, z of each vertex
  std::vector<Column> columns;

  std::int64_t count() const { return static_cast<std::int64_t>(this->positions.size() / 3); }
};

/** Calls `take` with the corners of each triangle of the fan of a polygon. */
template <class Take>
void forEachFanTriangle(std::span<const std::int64_t> polygon, Take&& take)
{
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    take(std::array{ polygon[0], polygon[i - 1], polygon[i] });
  }
}

/** Consecutive elements of a restored mesh: polygons of any number of corners, or tetrahedra. */
struct RestoredElements
{
  std::int64_t first = 0;
  std::vector<std::uint32_t> sizes;  ///< corners of each element
  std::vector<std::int64_t> corners; ///< original numbers of vertices
  std::vector<Column> columns;

  std::int64_t count() const { return static_cast<std::int64_t>(this->sizes.size()); }

  /** Calls `take` with the corners of each element and its index here, in order. */
  template <class Take>
  void forEach(Take&& take) const
  {
    std::size_t begin = 0;
    for (std::size_t element = 0; element < this->sizes.size(); ++element)
    {
      const std::size_t size = this->sizes[element];
      take(std::span<const std::int64_t>(this->corners).subspan(begin, size), element);
      begin += size;
    }
  }

  /** The same with the triangles of the fan of each element. */
  template <class Take>
  void forEachTriangle(Take&& take) const
  {
    this->forEach([&take](std::span<const std::int64_t> polygon, std::size_t)
      { forEachFanTriangle(polygon, take); });
  }
};

} // namespace smg
