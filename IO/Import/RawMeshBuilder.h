// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Relabelling.h"
#include "IO/Files/InputFile.h"
#include "IO/Import/GroupTable.h"
#include "IO/Import/RawMesh.h"
#include "smg/Convert.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** Thrown by a builder that only looks at a file, as soon as the type of its cells is known; see
 * RawMeshBuilder::Look. */
struct SMG_EXPORT CellTypeFound
{
  CellType type;
};

/** What the tuples of a column of a mesh belong to. */
enum class ColumnOf : std::uint8_t
{
  Vertices,
  Elements
};

/**
 * Builds a raw mesh from a file during parsing, and converts all cells to triangles or tetrahedra.
 * Vertices and cells may come in any order; a cell may name later vertices.
 *
 * The cells of the mesh are the elements of the highest dimension, unless the others are asked for.
 * Lower ones count where they are in a group: triangles beside tetrahedra are facets then, and
 * lines and points the vertices that they have.
 *
 * Errors in the file are MeshErrors: the parser converts them to Errors with the position.
 */
class RawMeshBuilder
{
public:
  static constexpr std::int64_t MaxVertices = std::int64_t(NoIndex) - 1;

  /** What becomes of the mesh. */
  enum Use : std::uint8_t
  {
    Keep,
    /** Nothing is stored, and the first cell of the type that the mesh has ends the parser by
     * CellTypeFound: tetrahedra, which may follow triangles. Until then it declares the columns
     * that it knows, and may skip vertices. */
    Look
  };

  RawMeshBuilder(Workspace& workspace, CellChoice choice, Use use = Keep);

  Workspace& workspace() { return this->Space; }
  bool looks() const { return this->Used == Look; }
  /** The file has no tetrahedra: the first triangle says what its cells are. */
  void expectSurface() { this->IsSurface = true; }
  /** After CellTypeFound: the type, precision and columns; the counts are those of no mesh. */
  StreamInfo found(const CellTypeFound& cells) const;

  /** To be called before the first vertex if the numbers of the file have single precision. */
  void useSinglePrecision() { this->Mesh.doublePositions = false; }

  /** A column of the mesh. */
  struct BuiltColumn : RawColumn
  {
    bool isDropped = false;
  };
  /** Adds a column; null if its name is reserved or in use. For ImportColumn, through which columns
   * are filled. */
  BuiltColumn* addColumn(ColumnOf of, const ColumnSpec& spec);
  /** The same of a mesh that has been converted, with its groups, instead of those of a file. */
  void setGroups(MeshGroups groups)
  {
    this->HasGroupColumns = true;
    this->Mesh.groups = std::move(groups);
  }

  /** The groups of the file. */
  GroupTable& groups() { return this->Groups; }
  /** The groups that the elements from now on are in. */
  void setGroups(GroupSet set) { this->Current = set; }
  GroupSet currentGroups() const { return this->Current; }

  /** Puts a vertex, an edge or a polygon, which need not be an element of the file, into groups:
   * what it is in the mesh follows from the cells, as for elements. */
  void grouped(int dimension, std::span<const std::int64_t> corners, GroupSet set);
  /** Puts an element that has come into further groups. The numbers of such elements, from 0,
   * ascend. */
  void alsoIn(
    std::int64_t element, int dimension, std::span<const std::int64_t> corners, GroupSet set);

  /** Adds a vertex. Throws MeshError if a coordinate is not finite (or beyond single precision). */
  void vertex(double x, double y, double z);
  std::int64_t vertices() const { return this->Mesh.vertices; }

  /**
   * Declares the numbers by which corners from now on name vertices: `first` and following, for
   * `count` vertices from vertex `base` on. Otherwise they are those of all vertices, from 0 on.
   */
  void numberVertices(std::int64_t first, std::int64_t count = MaxVertices, std::int64_t base = 0);
  /** For a file that does not say how many vertices come, the line of the elements from now on:
   * with it checkCorners() tells of one that names a vertex which did not come. */
  void setLine(std::int64_t line) { this->Line = line; }
  /** Throws MeshError if a corner is not a vertex; to be called in the end, as finish() does. */
  void checkCorners() const;

  // Add an element by its corners: numbers of vertices. Throw MeshError if a corner is not a
  // vertex.
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
  /** Adds a triangle strip. */
  void strip(std::span<const std::int64_t> corners);

  // The same corner by corner, for elements that do not fit into memory: all corners of a fan or of
  // strips, then endTriangles().
  void fanCorner(std::int64_t corner)
  {
    if (this->Corners >= 2)
    {
      this->triangleOfElement(this->First, this->Last, corner);
    }
    this->First = this->Corners == 0 ? corner : this->First;
    this->Last = corner;
    ++this->Corners;
  }
  void stripCorner(std::int64_t corner)
  {
    if (this->Corners >= 2)
    {
      // Every other triangle of a strip is reversed, so that all have the same orientation.
      const bool odd = this->Corners % 2 != 0;
      this->triangleOfStrip(odd ? this->Last : this->First, odd ? this->First : this->Last, corner);
    }
    this->First = this->Last;
    this->Last = corner;
    ++this->Corners;
  }
  /** The next corner begins another strip of the element. */
  void endStrip() { this->Corners = 0; }
  /** An element without triangles is dropped. */
  void endTriangles();
  /** The corners so far of the current fan or strip. */
  std::int64_t corners() const { return this->Corners; }
  /**
   * Splits a hexahedron (8 corners), wedge (6) or pyramid (5), with corners in VTK's order, into
   * tetrahedra. Each face is split along the diagonal of its least corner, so that neighbours
   * match.
   */
  void solid(std::span<const std::int64_t> corners);
  /** Any of these, by its dimension and corners. The first triangle of a wedge faces inwards; that
   * of VTK's faces outwards. `isHigherOrder`: it has further points, which are not used. */
  void element(int dimension, std::span<const std::int64_t> corners, bool isHigherOrder = false);
  /** A point or a line that is in no group, or another element without triangles and tetrahedra. */
  void dropped()
  {
    ++this->Mesh.counts.droppedCells;
    this->endElement(0);
  }
  /** A point, which is the vertex of this number. */
  void point(std::int64_t corner) { this->element(0, std::span(&corner, 1)); }
  /** A line, which is an edge of triangles or has two vertices. */
  void line(std::int64_t a, std::int64_t b) { this->element(1, std::array{ a, b }); }
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
  /** Of the cells so far: 2 or 3. */
  int dimension() const { return cornersOf(this->Mesh.cellType) - 1; }

  /** Declares that vertices have other numbers than those of their corners: `numbers` contains the
   * vertex of each. Applied by finish(); a corner without a vertex is a MeshError. */
  void relabelCorners(Relabelling numbers) { this->Numbers.emplace(std::move(numbers)); }

  /** Returns the mesh. Throws MeshError if there are no cells, a corner is not a vertex, or a
   * column does not have a tuple for each vertex or element. */
  RawMesh finish();

private:
  void take(CellType type, std::span<const std::int64_t> corners);
  /** Whether elements of this kind are cells of the mesh. The first tetrahedron makes triangles
   * facets. */
  bool wants(CellType type);
  /** Keeps an element of a lower dimension than the cells, if it is in a group. */
  bool keep(std::size_t dimension, std::span<const std::int64_t> corners, GroupSet set);
  /** The same of a triangle or polygon: they may turn out to be facets. */
  bool keepFacets(std::span<const std::int64_t> corners, GroupSet set);
  void makeTrianglesFacets();
  std::uint32_t vertexOf(std::int64_t corner);
  void finishGroups();
  void addFurtherGroups();
  void triangleOfElement(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    if (this->wants(CellType::Triangle))
    {
      this->cell(std::array<std::int64_t, 3>{ a, b, c });
      ++this->Triangles;
    }
  }
  /** Triangles that begin with the same corner are the fan of a polygon, which the original order
   * restores: another one than the first of a strip begins with another corner. */
  void triangleOfStrip(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    if (this->Triangles == 0)
    {
      this->StripApex = a;
    }
    const bool turns = this->Triangles > 0 && a == this->StripApex;
    turns ? this->triangleOfElement(b, c, a) : this->triangleOfElement(a, b, c);
  }
  void cell(std::span<const std::int64_t> corners);
  [[noreturn]] void failAtCorner(std::int64_t number, std::int64_t count, std::int64_t line) const;
  void endElement(std::int64_t cells);
  void noteElements(std::int64_t cells);
  void noteGroups(std::int64_t cells);
  /** Replaces the numbers of corners by those of their vertices. `what` has these corners. */
  void renumber(RecordFile<std::uint32_t>& corners, std::size_t count, const std::string& what);
  std::vector<RawColumn> finishColumns(ColumnOf of, std::int64_t tuples);
  /** Whether a column has groups that do not go with the cells of the mesh: see
   * MeshGroups::isOfMesh(). */
  static bool isOfOtherCells(const ColumnSpec& spec, ColumnOf of, CellType cells)
  {
    return isGroupColumn(spec.name) &&
           !MeshGroups::isOfMesh(spec, of == ColumnOf::Vertices, cornersOf(cells));
  }
  /** The columns that go with these cells. */
  std::vector<ColumnSpec> specs(ColumnOf of, CellType cells) const
  {
    std::vector<ColumnSpec> specs;
    for (const BuiltColumn& column : this->Columns[std::size_t(of)])
    {
      if (!isOfOtherCells(column.spec, of, cells))
      {
        specs.push_back(column.spec);
      }
    }
    return specs;
  }

  Workspace& Space;
  CellChoice Choice;
  Use Used;
  RawMesh Mesh;
  std::optional<CellType> Kind; ///< of the cells so far
  bool IsSurface = false;       ///< see expectSurface()
  bool ElementIsCell = true;    ///< so far

  std::int64_t FirstNumber = 0, NumberCount = MaxVertices, BaseVertex = 0; ///< see numberVertices()
  std::int64_t Line = 0;
  std::int64_t LargestCorner = -1, LineOfLargest = 0; ///< the largest vertex of a cell

  // The current fan or strip; of a strip, First is the corner before the last one.
  std::int64_t First = 0, Last = 0, Corners = 0;
  std::int64_t Triangles = 0; ///< of the current element
  bool IsFacet = false; ///< whether the current element is kept for the case that it is a facet
  std::int64_t StripApex = 0; ///< the first corner of the first of them, if they are of strips

  std::array<std::deque<BuiltColumn>, 2> Columns; ///< by ColumnOf
  GroupTable Groups;
  bool HasGroupColumns = false; ///< whether columns of groups may come: they belong to the groups
  GroupSet Current = GroupTable::None;
  RecordFile<GroupSet> ElementGroups; ///< of each element, from the first one in a group on
  struct FurtherGroups
  {
    std::uint32_t element;
    GroupSet set;
  };
  RecordFile<FurtherGroups> Further;               ///< see alsoIn()
  std::int64_t CellElements = 0, GroupedCells = 0; ///< elements that are cells; those in groups
  std::array<GroupedElements, 3> Lower;            ///< elements that are no cells, by dimension
  std::optional<Relabelling> Numbers;
};

/**
 * Reads a mesh stream as a raw mesh: vertices are numbered by their stream indices, elements are
 * the cells. All columns are read except CellFlags, which are computed from the cells. Throws
 * Error, which names the stream `name`.
 */
RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace);

} // namespace smg
