// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/RestoredMesh.h"

#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <algorithm>
#include <span>

// A mesh stream brought back into the order of its original file. The corners of the stream are
// replaced by original numbers of vertices (Relabelling), and vertices and cells are sorted by
// their original numbers (Restorers.h). The stream is read twice: once for vertices and corners,
// once for the columns of the cells.

namespace smg
{

namespace
{

const ColumnSpec VertexNumbers{ OriginalIdName, ScalarType::Int64, 1 };

/** The names of the columns, followed by `last`: the original numbers come last, and the columns of
 * the mesh first. */
std::vector<std::string> namesWith(const std::vector<ColumnSpec>& specs, const std::string& last)
{
  std::vector<std::string> names = columnNames(specs);
  names.push_back(last);
  return names;
}

/** Shares of the work. */
constexpr double VerticesShare = RestoredMesh::SortedShare * 0.4;
constexpr double CellsShare = RestoredMesh::SortedShare * 0.8;

} // namespace

std::vector<ColumnSpec> ownColumns(const std::vector<ColumnSpec>& specs, GroupForm groups)
{
  std::vector<ColumnSpec> own;
  std::copy_if(specs.begin(), specs.end(), std::back_inserter(own),
    [groups](const ColumnSpec& spec)
    {
      const bool isOfGroups = (spec.name == FacetGroupsName && groups != GroupForm::Columns) ||
                              (spec.name == VertexGroupsName && groups == GroupForm::None);
      return spec != VertexNumbers && spec != OriginalCellIdSpec && spec.name != CellFlagsName &&
             !isOfGroups;
    });
  return own;
}

RestoredMesh::RestoredMesh(
  VsmReader& reader, Workspace& workspace, std::int64_t maxCorners, GroupForm groups)
  : Space(workspace)
  , Name(reader.path().string())
{
  this->readInfo(reader, groups);
  // The table of the numbers is released before the cells are merged, which then have that memory
  // as well.
  const std::int64_t memory = workspace.available();
  this->Vertices = std::make_unique<VertexRestorer>(workspace, memory / 4, this->Info, this->Name);
  this->Elements = std::make_unique<ElementRestorer>(workspace, memory / 3, this->Info, maxCorners);
  {
    Relabelling ids(workspace, reader.info().vertices, memory / 4);
    RecordFile<std::uint32_t> corners(workspace);
    this->readVertices(reader, ids, corners);
    // Isolated vertices have original numbers as well: with them every number occurs once.
    this->readIsolated(reader);
    this->Vertices->sort();
    this->readCells(reader, ids, corners);
  }
  workspace.tell(CellsShare);
  this->Elements->restore(this->Info);
  const std::vector<std::string> notes = this->Elements->notes();
  this->Notes.insert(this->Notes.end(), notes.begin(), notes.end());
  workspace.tell(SortedShare);
}

void RestoredMesh::readInfo(const VsmReader& reader, GroupForm groups)
{
  const StreamInfo& stream = reader.info();
  if (findColumn(stream.vertexColumns, VertexNumbers) < 0)
  {
    throw Error(this->Name +
                ": has no column OriginalId of one int64 a vertex, without which the original "
                "order is not known: convert the original file, and keep that column.");
  }
  this->Info.cellType = stream.cellType;
  this->Info.doublePositions = stream.doublePositions;
  this->Info.isolated = reader.isolatedVertices();
  this->Info.vertices = stream.vertices + this->Info.isolated;
  this->Info.cells = stream.cells;
  this->Info.vertexColumns = ownColumns(stream.vertexColumns, groups);
  this->Info.elementColumns = ownColumns(stream.cellColumns, groups);
  this->Info.groupTable = stream.groups;
  // Numbers of vertices have 32 bits in the relabelling.
  if (this->Info.vertices >= std::int64_t(NoIndex))
  {
    throw Error(this->Name + ": has " + std::to_string(this->Info.vertices) +
                " vertices; the original order can be restored of at most 4294967294.");
  }
  this->KnowsCells = findColumn(stream.cellColumns, OriginalCellIdSpec) >= 0;
  if (this->KnowsCells && groups == GroupForm::Sides && !stream.groups.empty())
  {
    this->Info.elementColumns.push_back(OriginalCellIdSpec);
  }
  if (!this->KnowsCells)
  {
    this->Notes.push_back("The cells are in the order of the mesh stream, since it has no column "
                          "OriginalCellId.");
  }
}

void RestoredMesh::readVertices(
  VsmReader& reader, Relabelling& ids, RecordFile<std::uint32_t>& corners)
{
  const auto source = reader.source(namesWith(this->Info.vertexColumns, OriginalIdName), {});
  std::vector<std::uint32_t> numbers;
  for (MeshBlock block; source->next(block);)
  {
    const std::span<const std::int64_t> originals =
      std::as_const(block.vertexColumns.back()).as<std::int64_t>();
    this->Vertices->put(originals, block.positions, block.vertexColumns);
    for (std::size_t i = 0; i < originals.size(); ++i)
    {
      ids.put(static_cast<std::uint32_t>(block.firstVertex + static_cast<std::int64_t>(i)),
        static_cast<std::uint32_t>(originals[i]));
    }
    // The corners go to a file, since their original numbers are known only when all vertices have
    // been read.
    numbers.assign(block.corners.begin(), block.corners.end());
    corners.put(std::span<const std::uint32_t>(numbers));
    this->Space.tell(
      VerticesShare * static_cast<double>(block.firstCell) / static_cast<double>(this->Info.cells));
  }
  corners.close();
}

void RestoredMesh::readIsolated(VsmReader& reader)
{
  // The columns of the info come first, as with the other vertices.
  std::vector<std::ptrdiff_t> places;
  for (const ColumnSpec& spec : this->Info.vertexColumns)
  {
    places.push_back(findColumn(reader.info().vertexColumns, spec));
  }
  IsolatedVertices chunk;
  const std::int64_t rows = VsmFormat::blockRows(rowBytes(reader.info().vertexColumns));
  for (std::int64_t first = 0; first < this->Info.isolated; first += rows)
  {
    reader.readIsolated(first, std::min(rows, this->Info.isolated - first), chunk);
    std::vector<Column> columns;
    for (const std::ptrdiff_t place : places)
    {
      columns.push_back(std::move(chunk.columns[static_cast<std::size_t>(place)]));
    }
    this->Vertices->put(chunk.ids, chunk.positions, columns);
  }
}

void RestoredMesh::readCells(
  VsmReader& reader, Relabelling& ids, RecordFile<std::uint32_t>& corners)
{
  std::vector<std::string> names = columnNames(this->Info.elementColumns);
  if (this->KnowsCells && findColumn(this->Info.elementColumns, OriginalCellIdSpec) < 0)
  {
    names.emplace_back(OriginalCellIdName);
  }
  const auto source = reader.source({}, names);
  const auto cornersOfCell = static_cast<std::size_t>(cornersOf(this->Info.cellType));
  MeshBlock block;
  std::size_t cell = 0; // of the block
  std::size_t cells = 0;
  ids.apply(corners, cornersOfCell,
    [&](std::span<const std::uint32_t> numbers)
    {
      // The corners come from the relabelling and the columns from a second reading of the stream,
      // in the same order.
      while (cell == cells && source->next(block))
      {
        cell = 0;
        cells = block.corners.size() / cornersOfCell;
        this->Space.tell(VerticesShare + (CellsShare - VerticesShare) *
                                           static_cast<double>(block.firstCell) /
                                           static_cast<double>(this->Info.cells));
      }
      std::int64_t number = block.firstCell + static_cast<std::int64_t>(cell);
      if (this->KnowsCells)
      {
        number = std::as_const(block.cellColumns[names.size() - 1]).as<std::int64_t>()[cell];
      }
      if (number < 0)
      {
        throw Error(this->Name + ": cell " +
                    std::to_string(block.firstCell + static_cast<std::int64_t>(cell)) +
                    " has the OriginalCellId " + std::to_string(number) +
                    ", but the original numbers are not negative: convert the original file anew.");
      }
      this->Elements->put(number, numbers, block.cellColumns, cell++);
    });
}

/** Reports the progress after `count` more vertices or elements. */
void RestoredMesh::deliver(std::int64_t count)
{
  this->Delivered += count;
  this->Space.tell(SortedShare + (1 - SortedShare) * static_cast<double>(this->Delivered) /
                                   static_cast<double>(this->Info.vertices + this->Info.elements));
}

bool RestoredMesh::next(VertexChunk& vertices)
{
  const bool more = this->Vertices->next(vertices);
  this->deliver(vertices.count());
  return more;
}

bool RestoredMesh::next(ElementChunk& elements)
{
  const bool more = this->Elements->next(elements);
  this->deliver(elements.count());
  return more;
}

} // namespace smg
