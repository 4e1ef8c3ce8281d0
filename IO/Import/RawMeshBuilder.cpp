// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/RawMeshBuilder.h"

#include "IO/Files/FileNames.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/SolidSplit.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace smg
{

RawMeshBuilder::RawMeshBuilder(Workspace& workspace, CellChoice choice, Use use)
  : Space(workspace)
  , Choice(choice)
  , Used(use)
  , Mesh(workspace)
{
  if (choice != CellChoice::Only)
  {
    this->Mesh.cellType =
      choice == CellChoice::Triangles ? CellType::Triangle : CellType::Tetrahedron;
    this->Kind = this->Mesh.cellType;
  }
}

RawMeshBuilder::BuiltColumn* RawMeshBuilder::addColumn(ColumnOf of, const ColumnSpec& spec)
{
  std::deque<BuiltColumn>& columns = this->Columns[std::size_t(of)];
  // Leaves room for numbers, flags and results.
  constexpr std::size_t Most = VsmFormat::MaxColumns - 96;
  if (columns.size() >= Most)
  {
    const std::string note = "Columns after the first " + std::to_string(Most) +
                             " of the vertices or of the cells are left out.";
    if (this->Mesh.counts.notes.empty() || this->Mesh.counts.notes.back() != note)
    {
      this->note(note);
    }
    return nullptr;
  }
  const bool isTaken = std::ranges::any_of(
    columns, [&spec](const BuiltColumn& column) { return column.spec.name == spec.name; });
  // Flags of cells are computed; those of a file might be wrong.
  const bool isReserved =
    isReservedColumn(spec.name) || (of == ColumnOf::Elements && spec.name == CellFlagsName);
  if (isReserved || isTaken || spec.components < 1)
  {
    this->Mesh.counts.droppedColumns.push_back(spec.name);
    return nullptr;
  }
  // Many columns, which may be filled concurrently, share the memory of a few.
  const std::int64_t share = this->Space.available() / 16 / (std::ssize(columns) + 1);
  columns.push_back({ RawColumn{ spec, BucketFile(this->Space, 1, share) } });
  return this->looks() ? nullptr : &columns.back();
}

StreamInfo RawMeshBuilder::found(const CellTypeFound& cells) const
{
  StreamInfo info;
  info.cellType = cells.type;
  info.doublePositions = this->Mesh.doublePositions;
  for (const BuiltColumn& column : this->Columns[std::size_t(ColumnOf::Vertices)])
  {
    info.vertexColumns.push_back(column.spec);
  }
  for (const BuiltColumn& column : this->Columns[std::size_t(ColumnOf::Elements)])
  {
    info.cellColumns.push_back(column.spec);
  }
  return info;
}

std::vector<RawColumn> RawMeshBuilder::finishColumns(ColumnOf of, std::int64_t tuples)
{
  std::vector<RawColumn> kept;
  for (BuiltColumn& column : this->Columns[std::size_t(of)])
  {
    if (column.isDropped)
    {
      continue;
    }
    const auto bytes = static_cast<std::int64_t>(column.spec.tupleBytes());
    if (column.tuples.bytes() != bytes * tuples)
    {
      throw MeshError("the column " + inQuotes(column.spec.name) + " has " +
                      std::to_string(column.tuples.bytes() / bytes) + " values, not " +
                      std::to_string(tuples));
    }
    column.tuples.close();
    kept.push_back(std::move(column));
  }
  return kept;
}

void RawMeshBuilder::vertex(double x, double y, double z)
{
  const std::array<double, 3> doubles{ x, y, z };
  const std::array<float, 3> floats{ static_cast<float>(x), static_cast<float>(y),
    static_cast<float>(z) };
  const bool isDouble = this->Mesh.doublePositions;
  // A sum of products by zero is zero if and only if all are finite.
  const bool finite =
    isDouble ? x * 0 + y * 0 + z * 0 == 0 : floats[0] * 0 + floats[1] * 0 + floats[2] * 0 == 0;
  if (!finite)
  {
    throw MeshError(std::isfinite(x) && std::isfinite(y) && std::isfinite(z)
                      ? "a coordinate is beyond the range of single precision"
                      : "a coordinate is not finite");
  }
  if (this->Mesh.vertices >= MaxVertices)
  {
    throw MeshError("the mesh has more than 4294967294 vertices, which are too many");
  }
  ++this->Mesh.vertices;
  if (this->looks())
  {
    return;
  }
  isDouble ? this->Mesh.positions.put(0, doubles) : this->Mesh.positions.put(0, floats);
}

bool RawMeshBuilder::wants(CellType type)
{
  if (this->looks() && (!this->Kind || *this->Kind == type))
  {
    throw CellTypeFound{ type };
  }
  if (!this->Kind)
  {
    this->Kind = this->Mesh.cellType = type;
  }
  if (*this->Kind != type && this->Choice == CellChoice::Only)
  {
    throw MeshError("the file has both surface cells and volume cells: choose the ones to keep, "
                    "triangles or tets (option --cells)");
  }
  return *this->Kind == type;
}

void RawMeshBuilder::numberVertices(std::int64_t first, std::int64_t count, std::int64_t base)
{
  this->FirstNumber = first;
  this->NumberCount = std::min(count, MaxVertices);
  this->BaseVertex = base;
}

void RawMeshBuilder::cell(std::span<const std::int64_t> corners)
{
  std::array<std::uint32_t, 4> vertices{};
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    // Without overflow: numbers may be any.
    const std::uint64_t place =
      static_cast<std::uint64_t>(corners[k]) - static_cast<std::uint64_t>(this->FirstNumber);
    if (place >= static_cast<std::uint64_t>(this->NumberCount))
    {
      this->failAtCorner(corners[k], this->NumberCount, 0);
    }
    const std::int64_t vertex = this->BaseVertex + static_cast<std::int64_t>(place);
    if (vertex > this->LargestCorner)
    {
      this->LargestCorner = vertex;
      this->LineOfLargest = this->Line;
    }
    vertices[k] = static_cast<std::uint32_t>(vertex);
  }
  this->Mesh.corners.put(std::span<const std::uint32_t>(vertices.data(), corners.size()));
  ++this->Mesh.cells;
}

void RawMeshBuilder::checkCorners() const
{
  if (!this->Numbers && this->LargestCorner >= this->Mesh.vertices)
  {
    this->failAtCorner(
      this->LargestCorner + this->FirstNumber, this->Mesh.vertices, this->LineOfLargest);
  }
}

void RawMeshBuilder::failAtCorner(std::int64_t number, std::int64_t count, std::int64_t line) const
{
  const std::string first = std::to_string(this->FirstNumber);
  throw MeshError("the corner " + std::to_string(number) + " is not a vertex: " +
                    (count == 0              ? "there are none"
                      : count == MaxVertices ? "they count from " + first
                                             : "they are " + first + " to " +
                                                 std::to_string(this->FirstNumber + (count - 1))),
    line);
}

void RawMeshBuilder::take(CellType type, std::span<const std::int64_t> corners)
{
  if (!this->wants(type))
  {
    this->dropped();
    return;
  }
  this->cell(corners);
  this->endElement(1);
}

void RawMeshBuilder::endElement(std::int64_t cells)
{
  if (cells != 1 || !this->ElementIsCell)
  {
    this->noteElements(cells);
  }
  ++this->Mesh.elementCount;
  if (std::max(this->Mesh.cells, this->Mesh.elementCount) > std::int64_t(NoIndex) - 1)
  {
    throw MeshError("the mesh has more than 4294967294 cells, which are too many");
  }
}

/** Stores the element of its cells, the last ones, from the first element that is not one cell. */
void RawMeshBuilder::noteElements(std::int64_t cells)
{
  if (this->ElementIsCell)
  {
    this->ElementIsCell = false;
    for (std::int64_t cell = 0; cell < this->Mesh.cells - cells; ++cell)
    {
      this->Mesh.elements.put(static_cast<std::uint32_t>(cell));
    }
  }
  for (std::int64_t i = 0; i < cells; ++i)
  {
    this->Mesh.elements.put(static_cast<std::uint32_t>(this->Mesh.elementCount));
  }
}

void RawMeshBuilder::polygon(std::span<const std::int64_t> corners)
{
  for (const std::int64_t corner : corners)
  {
    this->fanCorner(corner);
  }
  this->endTriangles();
}

void RawMeshBuilder::strip(std::span<const std::int64_t> corners)
{
  for (const std::int64_t corner : corners)
  {
    this->stripCorner(corner);
  }
  this->endTriangles();
}

void RawMeshBuilder::endTriangles()
{
  this->Corners = 0;
  const std::int64_t triangles = std::exchange(this->Triangles, 0);
  if (triangles == 0)
  {
    this->dropped();
    return;
  }
  this->Mesh.counts.triangulatedPolygons += triangles > 1 ? 1 : 0;
  this->endElement(triangles);
}

void RawMeshBuilder::solid(std::span<const std::int64_t> corners)
{
  if (!this->wants(CellType::Tetrahedron))
  {
    this->dropped();
    return;
  }
  const TetrahedraOfSolid tetrahedra = splitSolid(corners);
  if (tetrahedra.all().empty())
  {
    this->dropped();
    return;
  }
  for (const auto& tetrahedron : tetrahedra.all())
  {
    this->cell(tetrahedron);
  }
  ++this->Mesh.counts.splitCells;
  this->endElement(static_cast<std::int64_t>(tetrahedra.all().size()));
}

void RawMeshBuilder::element(int dimension, std::span<const std::int64_t> c, bool isHigherOrder)
{
  const std::int64_t before = this->cells();
  dimension < 2    ? this->dropped()
  : c.size() == 3  ? this->triangle(c[0], c[1], c[2])
  : dimension == 2 ? this->polygon(c)
  : c.size() == 4  ? this->tetrahedron(c[0], c[1], c[2], c[3])
  : c.size() == 6  ? this->solid(std::array{ c[0], c[2], c[1], c[3], c[5], c[4] })
                   : this->solid(c);
  if (isHigherOrder && this->cells() > before)
  {
    this->noteHigherOrder();
  }
}

RawMesh RawMeshBuilder::finish()
{
  RawMesh& mesh = this->Mesh;
  if (mesh.cells == 0)
  {
    throw MeshError(this->Choice == CellChoice::Only ? "the file has no triangles and no tetrahedra"
                    : this->Choice == CellChoice::Triangles
                      ? "the file has no triangles (option --cells)"
                      : "the file has no tetrahedra (option --cells)");
  }
  this->checkCorners();
  mesh.corners.close();
  if (this->Numbers)
  {
    RecordFile<std::uint32_t> corners(this->Space);
    std::int64_t cell = 0;
    this->Numbers->apply(mesh.corners, static_cast<std::size_t>(cornersOf(mesh.cellType)),
      [&](std::span<const std::uint32_t> numbers)
      {
        if (std::ranges::find(numbers, NoIndex) != numbers.end())
        {
          throw MeshError("cell " + std::to_string(cell) +
                          ", counted from 0, names a vertex that the file does not have");
        }
        ++cell;
        corners.put(numbers);
      });
    this->Numbers.reset();
    mesh.corners = std::move(corners);
    mesh.corners.close();
  }
  // Elements after the last cell need not be stored.
  mesh.positions.close();
  mesh.elements.close();
  mesh.vertexColumns = this->finishColumns(ColumnOf::Vertices, mesh.vertices);
  mesh.elementColumns = this->finishColumns(ColumnOf::Elements, mesh.elementCount);
  return std::move(mesh);
}

RawMesh readStream(MeshSource& source, const std::string& name, Workspace& workspace)
{
  const StreamInfo& info = source.info();
  const bool triangles = info.cellType == CellType::Triangle;
  RawMeshBuilder builder(workspace, CellChoice::Only);
  if (!info.doublePositions)
  {
    builder.useSinglePrecision();
  }
  std::vector<ImportColumn> vertexColumns, cellColumns;
  for (const ColumnSpec& spec : info.vertexColumns)
  {
    vertexColumns.emplace_back(builder, ColumnOf::Vertices, spec);
  }
  for (const ColumnSpec& spec : info.cellColumns)
  {
    spec.name == CellFlagsName ? cellColumns.emplace_back()
                               : cellColumns.emplace_back(builder, ColumnOf::Elements, spec);
  }
  try
  {
    for (MeshBlock block; source.next(block);)
    {
      for (std::size_t i = 0; i < block.positions.size(); i += 3)
      {
        builder.vertex(block.positions[i], block.positions[i + 1], block.positions[i + 2]);
      }
      for (std::size_t c = 0; c < vertexColumns.size(); ++c)
      {
        vertexColumns[c].append(block.vertexColumns[c].bytes);
      }
      const std::int64_t* corner = block.corners.data();
      const std::int64_t* const end = corner + block.corners.size();
      for (; corner != end; corner += triangles ? 3 : 4)
      {
        triangles ? builder.triangle(corner[0], corner[1], corner[2])
                  : builder.tetrahedron(corner[0], corner[1], corner[2], corner[3]);
      }
      for (std::size_t c = 0; c < cellColumns.size(); ++c)
      {
        cellColumns[c].append(block.cellColumns[c].bytes);
      }
    }
    return builder.finish();
  }
  catch (const MeshError& error)
  {
    throw Error(name + ": the stream cannot be brought into another order: " + error.what() + '.');
  }
}

} // namespace smg
