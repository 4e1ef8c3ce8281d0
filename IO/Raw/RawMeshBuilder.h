// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"
#include "IO/Raw/RawMesh.h"
#include "smg/Convert.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace smg
{

/** What is wrong with a mesh that is parsed, as a sentence without the place and the full stop. */
class MeshError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/**
 * Takes the mesh of a file as it is parsed and makes triangles or tetrahedra of whatever cells
 * there are. Vertices and cells may come in any sequence; a cell may name vertices that come later.
 *
 * What is wrong with the file is a MeshError: whoever parses makes an Error of it, with the place.
 */
class RawMeshBuilder
{
public:
  RawMeshBuilder(Workspace& workspace, CellChoice choice);

  Workspace& workspace() { return this->Space; }

  /** Before the first vertex, where the file's numbers are of single precision. */
  void useSinglePrecision() { this->Mesh.doublePositions = false; }

  /** Adds a column of the vertices; what it is known by below. Reserved names lead to no column. */
  int addVertexColumn(const ColumnSpec& spec);
  /** The same of the elements, of which CellFlags is reserved too. */
  int addElementColumn(const ColumnSpec& spec);
  /** Appends tuples to a column; without a column of this number nothing. */
  void vertexTuples(int column, std::span<const std::byte> tuples)
  {
    if (column >= 0)
    {
      this->Mesh.vertexColumns[std::size_t(column)].tuples.append(0, tuples);
    }
  }
  void elementTuples(int column, std::span<const std::byte> tuples)
  {
    if (column >= 0)
    {
      this->Mesh.elementColumns[std::size_t(column)].tuples.append(0, tuples);
    }
  }
  /** Says that a column has all its tuples: the memory of its last chunk is given back. */
  void endVertexColumn(int column)
  {
    if (column >= 0)
    {
      this->Mesh.vertexColumns[std::size_t(column)].tuples.close();
    }
  }
  void endElementColumn(int column)
  {
    if (column >= 0)
    {
      this->Mesh.elementColumns[std::size_t(column)].tuples.close();
    }
  }
  /** Takes a column out again, whatever it has. The numbers of the others stay. */
  void dropVertexColumn(int column);
  void dropElementColumn(int column);

  /** The next vertex. Throws MeshError if a coordinate is not finite (or beyond single precision).
   */
  void vertex(double x, double y, double z);
  std::int64_t vertices() const { return this->Mesh.vertices; }

  // The next element, by its corners: numbers of vertices from 0. Throw MeshError if a corner is no
  // number that a vertex can have, or the kind is not the only one of the file.
  void triangle(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    const std::array<std::int64_t, 3> corners{ a, b, c };
    this->take(CellType::Triangle, corners);
  }
  void tetrahedron(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d)
  {
    const std::array<std::int64_t, 4> corners{ a, b, c, d };
    this->take(CellType::Tetrahedron, corners);
  }
  /** Becomes a fan of triangles. Fewer than three corners are a dropped element. */
  void polygon(std::span<const std::int64_t> corners);
  /** A triangle strip; -1 starts another one. */
  void strip(std::span<const std::int64_t> corners);
  /**
   * A triangle of the next element, of which more may come: for polygons and strips whose corners
   * do not fit into memory. endTriangles() completes the element.
   */
  void triangleOfElement(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    if (this->wants(CellType::Triangle))
    {
      this->cell(std::array<std::int64_t, 3>{ a, b, c });
      ++this->ElementTriangles;
    }
  }
  /** Without any triangle the element is a dropped one. */
  void endTriangles();
  /**
   * A hexahedron (8 corners), wedge (6) or pyramid (5), corners in VTK's order, becomes tetrahedra.
   * Each face is cut along the diagonal of its least corner, so that neighbours fit together.
   */
  void solid(std::span<const std::int64_t> corners);
  /** A point, a line, or whatever else has no triangles and no tetrahedra. */
  void dropped();
  /** Counts that the last element had points beside its corners, which are not used. */
  void noteHigherOrder() { ++this->Mesh.counts.higherOrderCells; }
  /** Counts points that the parser merged. */
  void noteMerged(std::int64_t points) { this->Mesh.counts.mergedPoints += points; }
  /** Says how many time steps the file has, and partitions the one that is read. */
  void noteParts(std::int64_t timeSteps, std::int64_t partitions)
  {
    this->Mesh.counts.timeSteps = timeSteps;
    this->Mesh.counts.partitions = partitions;
  }
  void note(std::string sentence) { this->Mesh.counts.notes.push_back(std::move(sentence)); }

  std::int64_t elements() const { return this->Mesh.elementCount; }
  std::int64_t cells() const { return this->Mesh.cells; }

  /**
   * Says that corners were given by other numbers than the vertices': `numbers` has put() the
   * vertex of each. Applied by finish(); a corner without a vertex is a MeshError.
   */
  void relabelCorners(Relabelling numbers) { this->Numbers.emplace(std::move(numbers)); }

  /**
   * Gives the mesh. Throws MeshError if there are no vertices or no cells, a corner is no vertex,
   * or a column has not a tuple for each vertex or element.
   */
  RawMesh finish();

private:
  void take(CellType type, std::span<const std::int64_t> corners);
  /** Whether elements of this kind are wanted. Throws MeshError where the kinds are mixed. */
  bool wants(CellType type);
  void cell(std::span<const std::int64_t> corners);
  void endElement(std::int64_t cells);
  void noteElements(std::int64_t cells);

  Workspace& Space;
  CellChoice Choice;
  RawMesh Mesh;
  std::optional<CellType> Kind; ///< of the cells so far
  bool ElementIsCell = true;    ///< so far
  std::int64_t ElementTriangles = 0;
  std::int64_t LargestCorner = -1, LargestElement = -1;
  std::vector<std::uint8_t> DroppedVertexColumns, DroppedElementColumns;
  std::optional<Relabelling> Numbers;
};

} // namespace smg
