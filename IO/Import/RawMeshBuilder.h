// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"
#include "IO/Import/RawMesh.h"
#include "smg/Convert.h"
#include "smg/MeshSource.h"

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

/** An error in a parsed mesh: a sentence without position and full stop. */
class SMG_EXPORT MeshError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/**
 * Builds a raw mesh from a file during parsing, and converts all cells to triangles or tetrahedra.
 * Vertices and cells may come in any order; a cell may name later vertices.
 *
 * Errors in the file are MeshErrors: the parser converts them to Errors with the position.
 */
class RawMeshBuilder
{
public:
  RawMeshBuilder(Workspace& workspace, CellChoice choice);

  Workspace& workspace() { return this->Space; }

  /** To be called before the first vertex if the numbers of the file have single precision. */
  void useSinglePrecision() { this->Mesh.doublePositions = false; }

  /** Adds a column of the vertices and returns its number. Reserved names add no column. */
  int addVertexColumn(const ColumnSpec& spec);
  /** The same for the elements, where CellFlags is reserved, too. */
  int addElementColumn(const ColumnSpec& spec);
  /** Appends tuples to a column; does nothing if there is no column of this number. */
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
  /** Declares a column complete and releases the memory of its last chunk. */
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
  /** Removes a column. The numbers of the others do not change. */
  void dropVertexColumn(int column);
  void dropElementColumn(int column);

  /** Adds a vertex. Throws MeshError if a coordinate is not finite (or beyond single precision). */
  void vertex(double x, double y, double z);
  std::int64_t vertices() const { return this->Mesh.vertices; }

  // Add an element by its corners: numbers of vertices from 0. Throw MeshError if a corner is not a
  // valid number of a vertex, or if the file has elements of another kind.
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
  /** Adds a fan of triangles. With fewer than three corners the element is dropped. */
  void polygon(std::span<const std::int64_t> corners);
  /** Adds a triangle strip; -1 starts another one. */
  void strip(std::span<const std::int64_t> corners);
  /** Adds a triangle of the next element, which may have more: for polygons and strips whose
   * corners do not fit into memory. endTriangles() completes the element. */
  void triangleOfElement(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    if (this->wants(CellType::Triangle))
    {
      this->cell(std::array<std::int64_t, 3>{ a, b, c });
      ++this->ElementTriangles;
    }
  }
  /** An element without triangles is dropped. */
  void endTriangles();
  /**
   * Splits a hexahedron (8 corners), wedge (6) or pyramid (5), with corners in VTK's order, into
   * tetrahedra. Each face is split along the diagonal of its least corner, so that neighbours
   * match.
   */
  void solid(std::span<const std::int64_t> corners);
  /** The same for a wedge whose first triangle faces inwards; that of VTK's faces outwards. */
  void invertedPrism(std::span<const std::int64_t> c)
  {
    this->solid(std::array<std::int64_t, 6>{ c[0], c[2], c[1], c[3], c[5], c[4] });
  }
  /** A point, a line, or another element without triangles and tetrahedra. */
  void dropped();
  /** Counts that the last element had points besides its corners, which are not used. */
  void noteHigherOrder() { ++this->Mesh.counts.higherOrderCells; }
  /** Counts points that the parser merged. */
  void noteMerged(std::int64_t points) { this->Mesh.counts.mergedPoints += points; }
  /** Sets the number of time steps of the file, and of partitions of the current one. */
  void noteParts(std::int64_t timeSteps, std::int64_t partitions)
  {
    this->Mesh.counts.timeSteps = timeSteps;
    this->Mesh.counts.partitions = partitions;
  }
  void note(std::string sentence) { this->Mesh.counts.notes.push_back(std::move(sentence)); }

  std::int64_t elements() const { return this->Mesh.elementCount; }
  std::int64_t cells() const { return this->Mesh.cells; }

  /** Declares that corners were given by other numbers than those of the vertices: `numbers`
   * contains the vertex of each. Applied by finish(); a corner without a vertex is a MeshError. */
  void relabelCorners(Relabelling numbers) { this->Numbers.emplace(std::move(numbers)); }

  /** Returns the mesh. Throws MeshError if there are no vertices or no cells, a corner is not a
   * vertex, or a column does not have a tuple for each vertex or element. */
  RawMesh finish();

private:
  void take(CellType type, std::span<const std::int64_t> corners);
  /** Whether elements of this kind are requested. Throws MeshError if the kinds are mixed. */
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

/**
 * Reads a mesh stream as a raw mesh: vertices are numbered by their stream indices, elements are
 * the cells. All columns are read except CellFlags, which are computed from the cells. Throws
 * Error, which names the stream `name`.
 */
RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace);

} // namespace smg
