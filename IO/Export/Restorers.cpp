// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/Restorers.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstring>
#include <utility>

// Vertices and elements in the order of the original file, by external sorts with the original
// numbers as keys, in the memory of the workspace.
//
// Polygons were cut into triangles that have the number of their polygon, from which they are
// restored (TriangleChains.h). Other elements are written cell by cell, which a note says.

namespace smg
{
namespace
{

/** The approximate bytes per triangle of the search for a polygon. */
constexpr std::size_t BytesOfFanTriangle = 64;

constexpr std::int64_t ChunkElements = 8192;
constexpr std::size_t ChunkCorners = std::size_t(64) << 10;
/** The approximate bytes of columns delivered at once. */
constexpr std::size_t ElementChunkBytes = std::size_t(512) << 10;

/** The memory for an element that is processed as a whole. */
std::int64_t elementBytes(Workspace& workspace)
{
  return workspace.pool().limit() / 8;
}

/** The approximate bytes of vertices delivered at once. */
constexpr std::size_t VertexChunkBytes = std::size_t(512) << 10;

} // namespace

ElementRestorer::ElementRestorer(
  Workspace& workspace, std::int64_t memory, const MeshFileInfo& info, std::int64_t maxCorners)
  : Space(workspace)
  , CornersOfCell(static_cast<std::size_t>(cornersOf(info.cellType)))
  , Columns(info.elementColumns)
  , Sorted(workspace, memory, this->CornersOfCell * sizeof(std::uint32_t) + this->Columns.bytes())
  , Elements(workspace)
  , MaxCorners(maxCorners)
  , MaxCells(static_cast<std::size_t>(elementBytes(workspace)) /
             (BytesOfFanTriangle + this->Columns.bytes()))
{
  std::ptrdiff_t place = 0;
  for (const ColumnSpec& spec : info.elementColumns)
  {
    this->FacetGroups =
      spec == MeshGroups::columnSpec(GroupOf::Facets, static_cast<int>(this->CornersOfCell))
        ? place
        : this->FacetGroups;
    place += static_cast<std::ptrdiff_t>(spec.tupleBytes());
  }
}

void ElementRestorer::put(std::int64_t element, std::span<const std::uint32_t> corners,
  const std::vector<Column>& columns, std::size_t tuple)
{
  std::byte* const row = this->Sorted.put(static_cast<std::uint64_t>(element));
  std::memcpy(row, corners.data(), corners.size_bytes());
  this->Columns.gather(columns, tuple, row + corners.size_bytes());
}

void ElementRestorer::restore(MeshFileInfo& info)
{
  this->Sorted.sort();
  // For the cells of one element, which are in memory together.
  const Reservation reserved(this->Space.pool(), elementBytes(this->Space));
  for (RowSort::Row row; this->Sorted.next(row);)
  {
    this->take(row);
  }
  this->endGroup();
  this->Elements.close();
  info.elements = this->Counts.elements;
  info.quadrilaterals = this->Counts.quadrilaterals;
  info.corners = this->Counts.corners;
  info.maxCorners = this->Counts.maxCorners;
}

/** Adds the next cell by ascending element. The cells of an element come in the order of put(),
 * since the sort is stable. */
void ElementRestorer::take(const RowSort::Row& row)
{
  if (row.key != this->Element)
  {
    this->endGroup();
    this->Element = row.key;
    this->TooLarge = false;
    this->MayBeFan = this->CornersOfCell == 3;
    std::memcpy(&this->Apex, row.bytes, sizeof(this->Apex));
  }
  if (this->Corners.size() == this->MaxCells * this->CornersOfCell)
  {
    // A polygon of more corners than fit into the memory stays triangles.
    this->TooLarge = true;
    this->writeCells();
  }
  const std::size_t size = this->Corners.size();
  this->Corners.resize(size + this->CornersOfCell);
  const std::size_t cornerBytes = this->CornersOfCell * sizeof(std::uint32_t);
  std::memcpy(&this->Corners[size], row.bytes, cornerBytes);
  this->MayBeFan = this->MayBeFan && this->Corners[size] == this->Apex;
  const std::byte* const tuples = row.bytes + cornerBytes;
  this->Tuples.insert(this->Tuples.end(), tuples, tuples + this->Columns.bytes());
}

/** Whether any edge of the collected cells is in a group, which the column of a polygon has no
 * components for. */
bool ElementRestorer::hasGroupedFacets() const
{
  const std::size_t bytes = this->Columns.bytes(),
                    cells = this->Corners.size() / this->CornersOfCell;
  for (std::size_t cell = 0; this->FacetGroups >= 0 && cell < cells; ++cell)
  {
    const auto sets = std::span(this->Tuples)
                        .subspan(cell * bytes + static_cast<std::size_t>(this->FacetGroups),
                          this->CornersOfCell * sizeof(GroupSet));
    if (std::ranges::any_of(sets, [](std::byte b) { return b != std::byte{}; }))
    {
      return true;
    }
  }
  return false;
}

/** Writes the polygon that became the collected cells. */
void ElementRestorer::writePolygon(bool isFan)
{
  const std::span<const std::uint32_t> polygon = isFan ? this->Fan.polygon() : this->Tree.polygon();
  if (!isFan && std::ssize(polygon) > this->MaxCorners)
  {
    this->Counts.maxCorners = std::max<std::int64_t>(this->Counts.maxCorners, std::ssize(polygon));
    this->writeInOrder(this->Tree.order());
    return;
  }
  const std::span<const std::byte> tuples = this->Tuples;
  const std::size_t bytes = this->Columns.bytes();
  // All tuples are equal if each equals the one before it.
  const bool same =
    std::equal(tuples.begin() + static_cast<std::ptrdiff_t>(bytes), tuples.end(), tuples.begin());
  this->Different += same ? 0 : 1;
  this->write(polygon, tuples.first(bytes));
  this->Corners.clear();
  this->Tuples.clear();
}

/** Writes the last collected cells of one element, as a polygon if they are its triangles. */
void ElementRestorer::endGroup()
{
  const bool isOne = this->Corners.size() <= this->CornersOfCell && !this->TooLarge;
  const bool mayBePolygon = !isOne && !this->TooLarge && this->CornersOfCell == 3;
  const bool isFan = mayBePolygon && this->MayBeFan && this->Fan.build(this->Corners);
  const bool isTree = mayBePolygon && !isFan && this->Tree.build(this->Corners);
  if (isFan || isTree)
  {
    if (this->hasGroupedFacets())
    {
      ++this->Grouped;
      isTree ? this->writeInOrder(this->Tree.order()) : this->writeCells();
      return;
    }
    this->writePolygon(isFan);
    return;
  }
  const bool isLargePolygon = this->TooLarge && this->MayBeFan;
  this->Large += isLargePolygon ? 1 : 0;
  this->Split += isOne || isLargePolygon ? 0 : 1;
  if (mayBePolygon)
  {
    this->Fan = {}; // whose memory serves for the strip
    this->Tree = {};
    if (this->Strip.build(this->Corners))
    {
      this->writeInOrder(this->Strip.order());
    }
  }
  this->writeCells();
}

void ElementRestorer::writeCell(std::size_t cell)
{
  const std::size_t bytes = this->Columns.bytes();
  this->write(std::span(this->Corners).subspan(cell * this->CornersOfCell, this->CornersOfCell),
    std::span(this->Tuples).subspan(cell * bytes, bytes));
}

/** Writes the collected cells in this order of their places. */
void ElementRestorer::writeInOrder(std::span<const std::uint32_t> cells)
{
  for (const std::uint32_t cell : cells)
  {
    this->writeCell(cell);
  }
  this->Corners.clear();
  this->Tuples.clear();
}

/** Writes the collected cells as they are. */
void ElementRestorer::writeCells()
{
  for (std::size_t cell = 0; cell < this->Corners.size() / this->CornersOfCell; ++cell)
  {
    this->writeCell(cell);
  }
  this->Corners.clear();
  this->Tuples.clear();
}

void ElementRestorer::write(
  std::span<const std::uint32_t> corners, std::span<const std::byte> tuples)
{
  // A record for each element: number of corners, corners, columns. It can be read any number of
  // times.
  const auto size = static_cast<std::uint32_t>(corners.size());
  this->Elements.put(0, size);
  this->Elements.append(0, std::as_bytes(corners));
  this->Elements.append(0, tuples);
  ++this->Counts.elements;
  this->Counts.quadrilaterals += size == 4 && this->CornersOfCell == 3 ? 1 : 0;
  this->Counts.corners += size;
  this->Counts.maxCorners = std::max<std::int64_t>(this->Counts.maxCorners, size);
}

std::vector<std::string> ElementRestorer::notes() const
{
  std::vector<std::string> notes;
  const std::string cells = this->CornersOfCell == 3 ? "triangles" : "tetrahedra";
  if (this->Split > 0)
  {
    notes.push_back(
      std::to_string(this->Split) +
      (this->Split == 1
          ? " cell of the original file, which became several " + cells + ", is"
          : " cells of the original file, which became several " + cells + " each, are") +
      " written as these " + cells + ".");
  }
  if (this->Grouped > 0)
  {
    notes.push_back(counted(this->Grouped, "polygon with edges in groups is",
                      "polygons with edges in groups are") +
                    " written as triangles, which have places for these.");
  }
  if (this->Large > 0)
  {
    notes.push_back(
      std::to_string(this->Large) +
      (this->Large == 1 ? " polygon of more than " : " polygons of more than ") +
      std::to_string(this->MaxCells) +
      (this->Large == 1 ? " corners is written as triangles: allow more memory to keep it."
                        : " corners are written as triangles: allow more memory to keep them."));
  }
  if (this->Different > 0)
  {
    notes.push_back(
      counted(this->Different,
        "polygon was triangles with different values in the mesh stream: it has ",
        "polygons were triangles with different values in the mesh stream: they have ") +
      "those of one of these.");
  }
  return notes;
}

bool ElementRestorer::next(ElementChunk& elements)
{
  if (!this->Reader)
  {
    this->Reader.emplace(this->Elements);
    this->Next = 0;
  }
  elements.first = this->Next;
  elements.sizes.clear();
  elements.corners.clear();
  elements.columns = emptyColumns(this->Columns.specs());
  std::vector<std::byte> tuples(this->Columns.bytes());
  std::vector<std::uint32_t> corners;
  // Chunks are bounded by elements, by corners and by the bytes of columns.
  const std::int64_t most = std::clamp<std::int64_t>(
    static_cast<std::int64_t>(ElementChunkBytes / (1 + this->Columns.bytes())), 1, ChunkElements);
  std::uint32_t size = 0;
  while (
    elements.count() < most && elements.corners.size() < ChunkCorners && this->Reader->get(size))
  {
    corners.resize(size);
    this->Reader->read(std::as_writable_bytes(std::span(corners)));
    this->Reader->read(tuples);
    elements.sizes.push_back(size);
    elements.corners.insert(elements.corners.end(), corners.begin(), corners.end());
    this->Columns.append(tuples.data(), elements.columns);
  }
  this->Next += elements.count();
  return elements.count() > 0;
}

VertexRestorer::VertexRestorer(
  Workspace& workspace, std::int64_t memory, const MeshFileInfo& info, std::string name)
  : Name(std::move(name))
  , Positions(info.doublePositions)
  , Columns(info.vertexColumns)
  , Count(info.vertices)
  , Chunk(static_cast<std::int64_t>(std::clamp<std::size_t>(
      VertexChunkBytes / (this->Positions.size() + this->Columns.bytes()), 1, 8192)))
  , Sorted(workspace, memory, this->Positions.size() + this->Columns.bytes())
{
}

void VertexRestorer::fail(const std::string& what) const
{
  throw Error(
    this->Name + ": " + what +
    ", so the original order cannot be restored: take the whole mesh that was converted, "
    "with its column OriginalId, or the .vsm file of it that has its points of no cell, too.");
}

void VertexRestorer::put(std::span<const std::int64_t> ids, std::span<const double> positions,
  const std::vector<Column>& columns)
{
  // Positions that were in single precision take half the room in the sort, and lose nothing.
  const std::size_t size = this->Positions.size();
  const std::byte* position = this->Positions.bytes(positions).data();
  for (std::size_t i = 0; i < ids.size(); ++i, position += size)
  {
    // Checked as they come: with all numbers in range, one that is missing means that another one
    // occurs twice.
    if (ids[i] < 0 || ids[i] >= this->Count)
    {
      this->fail("a vertex has the original number " + std::to_string(ids[i]) +
                 ", but there are only " + std::to_string(this->Count) + " vertices");
    }
    std::byte* const row = this->Sorted.put(static_cast<std::uint64_t>(ids[i]));
    std::memcpy(row, position, size);
    this->Columns.gather(columns, i, row + size);
  }
}

bool VertexRestorer::next(VertexChunk& vertices)
{
  vertices.first = this->Next;
  vertices.positions.clear();
  vertices.columns = emptyColumns(this->Columns.specs(), static_cast<std::size_t>(this->Chunk));
  this->Bytes.clear();
  RowSort::Row row;
  for (std::int64_t i = 0; i < this->Chunk && this->Sorted.next(row); ++i, ++this->Next)
  {
    // All numbers are below the number of vertices: if one is missing, another occurs twice.
    if (row.key != static_cast<std::uint64_t>(this->Next))
    {
      this->fail(row.key < static_cast<std::uint64_t>(this->Next)
                   ? "two vertices have the original number " + std::to_string(row.key)
                   : "no vertex has the original number " + std::to_string(this->Next));
    }
    this->Bytes.insert(this->Bytes.end(), row.bytes, row.bytes + this->Positions.size());
    this->Columns.append(row.bytes + this->Positions.size(), vertices.columns);
  }
  this->Positions.append(this->Bytes, vertices.positions);
  return !vertices.positions.empty();
}

} // namespace smg
