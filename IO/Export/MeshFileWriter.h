// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Format.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace smg
{

class GroupElements;

/** What a file is to hold. */
struct MeshFileInfo
{
  MeshFileInfo() = default;
  /** Of a mesh stream, in its order. */
  explicit MeshFileInfo(const StreamInfo& stream)
    : cellType(stream.cellType)
    , doublePositions(stream.doublePositions)
    , vertices(stream.vertices)
    , cells(stream.cells)
    , elements(stream.cells)
    , corners(stream.cells * cornersOf(stream.cellType))
    , maxCorners(cornersOf(stream.cellType))
    , vertexColumns(stream.vertexColumns)
    , elementColumns(stream.cellColumns)
    , groupTable(stream.groups)
  {
  }

  CellType cellType = CellType::Triangle;
  /** Whether positions have double precision; otherwise they were single precision numbers. */
  bool doublePositions = true;
  std::int64_t vertices = 0; ///< including isolated ones
  std::int64_t isolated = 0;
  std::int64_t cells = 0;          ///< triangles or tetrahedra
  std::int64_t elements = 0;       ///< polygons or tetrahedra
  std::int64_t quadrilaterals = 0; ///< elements that are polygons of four corners
  std::int64_t corners = 0;        ///< of all elements
  std::int64_t maxCorners = 0;     ///< of an element
  std::vector<ColumnSpec> vertexColumns;
  std::vector<ColumnSpec> elementColumns;
  /** The groups to which the columns of groups refer, of a format with these (GroupForm::Columns).
   */
  MeshGroups groupTable;
  bool text = false; ///< whether a format that has either form is to write text
  /** Facets and vertices in groups, for a format with places for them (Format::groups);
   * null: there are no groups. The sets of vertices and cells are columns, too. */
  std::shared_ptr<const GroupElements> groups = nullptr;
};

/** Consecutive vertices of a mesh. */
struct VertexChunk
{
  std::int64_t first = 0;
  std::vector<double> positions; ///< x, y, z of each vertex
  std::vector<Column> columns;

  std::int64_t count() const { return static_cast<std::int64_t>(this->positions.size() / 3); }

  /** Calls `take` with the position of each vertex and its index here, in order. */
  template <class Take>
  void forEach(Take&& take) const
  {
    const std::span<const double> all = this->positions;
    for (std::size_t vertex = 0; 3 * vertex < all.size(); ++vertex)
    {
      take(all.subspan(3 * vertex).first<3>(), vertex);
    }
  }
};

/** Consecutive elements of a mesh: polygons of any number of corners, or tetrahedra. */
struct ElementChunk
{
  std::int64_t first = 0;
  std::vector<std::uint32_t> sizes;  ///< corners of each element
  std::vector<std::int64_t> corners; ///< numbers of vertices
  std::vector<Column> columns;

  std::int64_t count() const { return static_cast<std::int64_t>(this->sizes.size()); }

  /** Calls `take` with the corners of each element and its index here, in order. */
  template <class Take>
  void forEach(Take&& take) const
  {
    const std::span<const std::int64_t> all = this->corners;
    std::size_t begin = 0;
    for (std::size_t element = 0; element < this->sizes.size(); ++element)
    {
      take(all.subspan(begin, this->sizes[element]), element);
      begin += this->sizes[element];
    }
  }

  /** The same, with the triangles of its fan instead of an element of more than `most` corners. */
  template <class Take>
  void forEachUpTo(std::size_t most, Take&& take) const
  {
    this->forEach(
      [&](std::span<const std::int64_t> polygon, std::size_t element)
      {
        if (polygon.size() <= most)
        {
          take(polygon, element);
          return;
        }
        for (std::size_t i = 2; i < polygon.size(); ++i)
        {
          const std::array triangle{ polygon[0], polygon[i - 1], polygon[i] };
          take(std::span<const std::int64_t>(triangle), element);
        }
      });
  }
};

/**
 * Writes a mesh file of a format, in whatever order its vertices and elements come. The format says
 * in which order it takes them (Format::writeOrder). Without finish() no file is left.
 */
class MeshFileWriter
{
public:
  virtual ~MeshFileWriter() = default;

  /** Writes the next vertices, from 0. Throws Error. */
  virtual void vertices(const VertexChunk& chunk) = 0;
  /** Writes the next elements, from 0. Throws Error. */
  virtual void elements(const ElementChunk& chunk) = 0;
  /** Asked when all elements have come: whether the file needs them once more, from 0. */
  virtual bool needsElementsAgain() { return false; }
  /** Completes the file, and gives it its name. Returns a sentence for each thing that the format
   * cannot hold as the mesh has it, except for polygons (Format::maxCorners). Throws Error. */
  virtual WriteNotes finish() = 0;
};

/** A MeshFileFunction of a writer that needs only the name of the file and its content. */
template <class Writer>
std::unique_ptr<MeshFileWriter> makeWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace*)
{
  return std::make_unique<Writer>(path, info);
}

} // namespace smg
