// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/RawMeshBuilder.h"

#include "IO/Files/FileNames.h"
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

namespace
{

/** Adds a column unless its name is reserved or in use; returns its number or -1. */
int addColumn(Workspace& space, const ColumnSpec& spec, std::vector<RawColumn>& columns,
  std::vector<std::uint8_t>& dropped, ImportCounts& counts)
{
  const bool taken = std::ranges::any_of(
    columns, [&spec](const RawColumn& column) { return column.spec.name == spec.name; });
  if (isReservedColumn(spec.name) || taken || spec.components < 1)
  {
    counts.droppedColumns.push_back(spec.name);
    return -1;
  }
  // Many columns, which may be filled concurrently, share the memory of a few.
  const std::int64_t share = space.available() / 16 / (std::ssize(columns) + 1);
  columns.push_back({ spec, BucketFile(space, 1, share) });
  dropped.push_back(0);
  return static_cast<int>(columns.size()) - 1;
}

void finishColumns(
  std::vector<RawColumn>& columns, const std::vector<std::uint8_t>& dropped, std::int64_t tuples)
{
  std::vector<RawColumn> kept;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (dropped[i])
    {
      continue;
    }
    const auto bytes = static_cast<std::int64_t>(columns[i].spec.tupleBytes());
    if (columns[i].tuples.bytes() != bytes * tuples)
    {
      throw MeshError("the column " + inQuotes(columns[i].spec.name) + " has " +
                      std::to_string(columns[i].tuples.bytes() / bytes) + " values, not " +
                      std::to_string(tuples));
    }
    columns[i].tuples.close();
    kept.push_back(std::move(columns[i]));
  }
  columns = std::move(kept);
}

} // namespace

RawMeshBuilder::RawMeshBuilder(Workspace& workspace, CellChoice choice)
  : Space(workspace)
  , Choice(choice)
  , Mesh(workspace)
{
  if (choice != CellChoice::Only)
  {
    this->Mesh.cellType =
      choice == CellChoice::Triangles ? CellType::Triangle : CellType::Tetrahedron;
    this->Kind = this->Mesh.cellType;
  }
}

int RawMeshBuilder::addVertexColumn(const ColumnSpec& spec)
{
  return addColumn(
    this->Space, spec, this->Mesh.vertexColumns, this->DroppedVertexColumns, this->Mesh.counts);
}

int RawMeshBuilder::addElementColumn(const ColumnSpec& spec)
{
  if (spec.name == CellFlagsName)
  {
    // The flags are computed; those of a file might be wrong.
    this->Mesh.counts.droppedColumns.push_back(spec.name);
    return -1;
  }
  return addColumn(
    this->Space, spec, this->Mesh.elementColumns, this->DroppedElementColumns, this->Mesh.counts);
}

void RawMeshBuilder::dropVertexColumn(int column)
{
  if (column >= 0)
  {
    this->DroppedVertexColumns[std::size_t(column)] = 1;
  }
}

void RawMeshBuilder::dropElementColumn(int column)
{
  if (column >= 0)
  {
    this->DroppedElementColumns[std::size_t(column)] = 1;
  }
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
  if (this->Mesh.vertices >= std::int64_t(NoIndex) - 1)
  {
    throw MeshError("the mesh has more than 4294967294 vertices, which are too many");
  }
  isDouble ? this->Mesh.positions.put(0, doubles) : this->Mesh.positions.put(0, floats);
  ++this->Mesh.vertices;
}

bool RawMeshBuilder::wants(CellType type)
{
  if (!this->Kind)
  {
    this->Kind = this->Mesh.cellType = type;
  }
  if (*this->Kind != type && this->Choice == CellChoice::Only)
  {
    throw MeshError(
      "the file has both surface cells and volume cells: choose the ones to keep, "
      "triangles or tets (option --cells, as for smg convert; in ParaView Cells of the converter)");
  }
  return *this->Kind == type;
}

void RawMeshBuilder::cell(std::span<const std::int64_t> corners)
{
  std::array<std::uint32_t, 4> numbers{};
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const std::int64_t corner = corners[k];
    if (static_cast<std::uint64_t>(corner) >= NoIndex - 1)
    {
      throw MeshError("the corner " + std::to_string(corner) + " can be no vertex");
    }
    if (corner > this->LargestCorner)
    {
      this->LargestCorner = corner;
      this->LargestElement = this->Mesh.elementCount;
    }
    numbers[k] = static_cast<std::uint32_t>(corner);
  }
  this->Mesh.corners.put(std::span<const std::uint32_t>(numbers.data(), corners.size()));
  ++this->Mesh.cells;
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
  if (corners.size() < 3 || !this->wants(CellType::Triangle))
  {
    this->dropped();
    return;
  }
  this->Mesh.counts.triangulatedPolygons += corners.size() > 3 ? 1 : 0;
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    this->cell(std::array<std::int64_t, 3>{ corners[0], corners[i - 1], corners[i] });
  }
  this->endElement(static_cast<std::int64_t>(corners.size()) - 2);
}

void RawMeshBuilder::strip(std::span<const std::int64_t> corners)
{
  if (!this->wants(CellType::Triangle))
  {
    this->dropped();
    return;
  }
  std::int64_t triangles = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (corners[i] == -1)
    {
      start = i + 1;
    }
    else if (i >= start + 2)
    {
      // Every other triangle of a strip is reversed, so that all have the same orientation.
      const bool odd = (i - start) % 2 != 0;
      this->cell(std::array<std::int64_t, 3>{
        corners[i - (odd ? 1 : 2)], corners[i - (odd ? 2 : 1)], corners[i] });
      ++triangles;
    }
  }
  if (triangles == 0)
  {
    this->dropped();
    return;
  }
  this->Mesh.counts.triangulatedPolygons += triangles > 1 ? 1 : 0;
  this->endElement(triangles);
}

void RawMeshBuilder::endTriangles()
{
  const std::int64_t triangles = std::exchange(this->ElementTriangles, 0);
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

void RawMeshBuilder::dropped()
{
  ++this->Mesh.counts.droppedCells;
  this->endElement(0);
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
  else if (this->LargestCorner >= mesh.vertices)
  {
    throw MeshError("element " + std::to_string(this->LargestElement) + " names vertex " +
                    std::to_string(this->LargestCorner) + ", counted from 0, but there are only " +
                    std::to_string(mesh.vertices) + " vertices");
  }
  // Elements after the last cell need not be stored.
  mesh.positions.close();
  mesh.elements.close();
  finishColumns(mesh.vertexColumns, this->DroppedVertexColumns, mesh.vertices);
  finishColumns(mesh.elementColumns, this->DroppedElementColumns, mesh.elementCount);
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
  std::vector<int> vertexColumns, cellColumns;
  for (const ColumnSpec& spec : info.vertexColumns)
  {
    vertexColumns.push_back(builder.addVertexColumn(spec));
  }
  for (const ColumnSpec& spec : info.cellColumns)
  {
    cellColumns.push_back(spec.name == CellFlagsName ? -1 : builder.addElementColumn(spec));
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
        builder.vertexTuples(vertexColumns[c], block.vertexColumns[c].bytes);
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
        builder.elementTuples(cellColumns[c], block.cellColumns[c].bytes);
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
