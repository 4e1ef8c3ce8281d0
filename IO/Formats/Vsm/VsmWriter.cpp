// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmWriter.h"

#include "IO/Formats/Vsm/PackedIntegers.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace smg
{

namespace
{

constexpr std::int64_t SavedLastCellBytes = std::int64_t(4) << 20;

TableSpec tableWith(std::string name, ColumnSpec first, const std::vector<ColumnSpec>& columns)
{
  TableSpec table{ std::move(name), { std::move(first) } };
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  return table;
}

void checkColumns(const std::vector<ColumnSpec>& columns, const std::string& file)
{
  if (columns.size() > VsmFormat::MaxColumns)
  {
    throw Error(file + ": has room for " + std::to_string(VsmFormat::MaxColumns) +
                " columns, but there are " + std::to_string(columns.size()) + ": leave some out.");
  }
  std::set<std::string> names;
  for (const ColumnSpec& column : columns)
  {
    if (column.name.empty() || column.components < 1 || !names.insert(column.name).second)
    {
      throw Error(file + ": column '" + column.name +
                  "' cannot be written: it needs a name of its own and at least one component.");
    }
    if (isReservedColumn(column.name))
    {
      throw Error(file + ": a column cannot have the name '" + column.name +
                  "', which is reserved: give it another name or leave it out.");
    }
    if (column.name == CellFlagsName && column != ColumnSpec{ CellFlagsName, ScalarType::UInt8, 1 })
    {
      throw Error(file + ": the column '" + column.name +
                  "' must be of one uint8 a cell: give it another name or leave it out.");
    }
  }
}

std::vector<TableSpec> tablesOf(const StreamInfo& info, const std::string& file)
{
  checkColumns(info.vertexColumns, file);
  checkColumns(info.cellColumns, file);
  const ScalarType real = positionType(info.doublePositions);
  const ColumnSpec firstVertex{ "FirstVertex", ScalarType::Int64, 1 };
  const ColumnSpec finalized{ "Finalized", ScalarType::Int64, 1 };
  std::vector<TableSpec> tables{ tableWith("vertices", { "Position", real, 3 }, info.vertexColumns),
    tableWith("last", { "LastCell", ScalarType::UInt8, 0 }, {}),
    tableWith("cells", { "Corners", ScalarType::UInt8, 0 }, info.cellColumns),
    tableWith("blocks", firstVertex, { finalized }), IsolatedWriter::table(info) };
  if (!info.groups.empty())
  {
    tables.push_back(VsmFile::groupTable());
  }
  return tables;
}

} // namespace

VsmWriter::VsmWriter(
  const std::filesystem::path& path, const StreamInfo& info, const VsmWriterOptions& options)
  : Name(path.string())
  , Info(info)
  , Corners(cornersOf(info.cellType))
  , Rows(info, this->Name)
  , Positions(info.doublePositions)
  , VertexRows(info.vertexColumns)
  , CellRows(info.cellColumns)
  , LastCell(options.scratch, SavedLastCellBytes)
  , Statistics(options.scratch)
  , Isolated(this->Name, info, this->Rows.vertices)
  , File(path, tablesOf(info, this->Name), options.codec, options.statistics, options.workers)
{
  this->Info.vertices = this->Info.cells = this->Info.width = this->Info.span = 0;
  for (int axis = 0; axis < 3; axis++)
  {
    this->Info.bounds[2 * axis] = std::numeric_limits<double>::infinity();
    this->Info.bounds[2 * axis + 1] = -std::numeric_limits<double>::infinity();
  }
}

VsmWriter::~VsmWriter() = default;

void VsmWriter::fail(const std::string& what) const
{
  throw Error(this->Name + ": " + what);
}

void VsmWriter::append(const MeshBlock& block)
{
  this->checkBlock(block);
  this->addVertices(block);
  this->addCells(block);
  if (block.finalized < this->Settled || block.finalized > this->Introduced)
  {
    this->fail("after cell " + std::to_string(this->Info.cells) + ", " +
               std::to_string(block.finalized) +
               " vertices are said to be final, but it can only be " +
               std::to_string(this->Settled) + " to " + std::to_string(this->Introduced) + ".");
  }
  this->settle(block.finalized);
}

void VsmWriter::checkBlock(const MeshBlock& block) const
{
  if (block.firstVertex != this->Info.vertices || block.firstCell != this->Info.cells)
  {
    this->fail("a block that begins with vertex " + std::to_string(block.firstVertex) +
               " and cell " + std::to_string(block.firstCell) + " does not continue a stream of " +
               std::to_string(this->Info.vertices) + " vertices and " +
               std::to_string(this->Info.cells) + " cells.");
  }
  const auto check = [this](const std::vector<Column>& columns,
                       const std::vector<ColumnSpec>& specs, std::size_t tuples)
  {
    for (std::size_t c = 0; c < specs.size(); c++)
    {
      if (c >= columns.size() || columns[c].bytes.size() != tuples * specs[c].tupleBytes())
      {
        this->fail("a block does not have " + std::to_string(tuples) + " values of column '" +
                   specs[c].name + "'.");
      }
    }
  };
  check(block.vertexColumns, this->Info.vertexColumns, block.positions.size() / 3);
  check(block.cellColumns, this->Info.cellColumns, block.corners.size() / this->Corners);
  if (block.positions.size() % 3 != 0 || block.corners.size() % this->Corners != 0)
  {
    this->fail("a block has an incomplete vertex or cell.");
  }
}

void VsmWriter::addVertices(const MeshBlock& block)
{
  for (std::int64_t done = 0; done < block.vertices();)
  {
    const std::int64_t count = std::min(
      block.vertices() - done, this->Rows.vertices - this->Info.vertices % this->Rows.vertices);
    this->addPositions(block, done, count);
    this->VertexRows.append(block.vertexColumns, done, count);
    this->Info.vertices += count;
    done += count;
    if (this->Info.vertices % this->Rows.vertices == 0)
    {
      this->flushVertices();
    }
  }
}

void VsmWriter::addPositions(const MeshBlock& block, std::int64_t first, std::int64_t count)
{
  for (std::int64_t i = 3 * first; i < 3 * (first + count); i++)
  {
    const double x = block.positions[i];
    if (!this->Positions.append(x))
    {
      this->fail("coordinate " + std::to_string(i % 3) + " of vertex " +
                 std::to_string(block.firstVertex + i / 3) + " is " + std::to_string(x) +
                 (std::isfinite(x) ? ", which is not a single precision number."
                                   : ", which is not a finite number."));
    }
    double* const bounds = &this->Info.bounds[2 * (i % 3)];
    bounds[0] = std::min(bounds[0], x);
    bounds[1] = std::max(bounds[1], x);
  }
}

void VsmWriter::addCells(const MeshBlock& block)
{
  const auto cells = static_cast<std::int64_t>(block.corners.size()) / this->Corners;
  for (std::int64_t done = 0; done < cells;)
  {
    const std::int64_t count =
      std::min(cells - done, this->Rows.cells - this->Info.cells % this->Rows.cells);
    if (this->Info.cells % this->Rows.cells == 0)
    {
      this->FirstVertex.push_back(this->Introduced);
    }
    for (std::int64_t i = 0; i < count; i++)
    {
      this->addCell(&block.corners[(done + i) * this->Corners]);
      this->Info.cells++;
    }
    this->CellRows.append(block.cellColumns, done, count);
    done += count;
    if (this->Info.cells % this->Rows.cells == 0)
    {
      this->flushCells();
    }
  }
}

void VsmWriter::addCell(const std::int64_t* corners)
{
  std::int64_t least = corners[0];
  std::int64_t most = corners[0];
  for (int k = 0; k < this->Corners; k++)
  {
    const std::int64_t v = corners[k];
    if (v < this->Settled || v > this->Introduced || v >= this->Info.vertices)
    {
      this->fail("cell " + std::to_string(this->Info.cells) + " uses vertex " + std::to_string(v) +
                 (v < 0                ? ", which does not exist."
                   : v < this->Settled ? ", which was said to be final."
                   : v > this->Introduced
                     ? " before any cell uses vertex " + std::to_string(this->Introduced) +
                         ": vertices are to be numbered by first use."
                     : ", which is not defined yet."));
    }
    this->Distances.push_back(static_cast<std::uint64_t>(this->Introduced - v));
    if (v == this->Introduced)
    {
      this->Introduced++;
      this->Statistics.introduce(this->Info.cells);
    }
    this->LastCell.at(v) = this->Info.cells;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  this->Info.span = std::max(this->Info.span, most - least);
}

/** Stores the last cells of the vertices up to `end`. */
void VsmWriter::settle(std::int64_t end)
{
  for (; this->Settled < end; this->Settled++)
  {
    const std::int64_t last = this->LastCell.get(this->Settled);
    this->Statistics.finalize(last);
    this->LastRows.push_back(zigzag(last - this->PreviousLast));
    this->PreviousLast = last;
    if (this->LastRows.size() == std::size_t(VsmFormat::BlockRows))
    {
      this->flushLast();
    }
    // The blocks that end before the vertex does: this is the first vertex that outlives them.
    while ((static_cast<std::int64_t>(this->Finalized.size()) + 1) * this->Rows.cells <= last)
    {
      this->Finalized.push_back(this->Settled);
    }
  }
  this->LastCell.discardBelow(this->Settled);
  this->Statistics.count(this->Info.cells, this->Settled);
}

void VsmWriter::flushVertices()
{
  this->File.append(VsmFormat::Vertices, std::int64_t(this->Positions.positions()),
    this->VertexRows.block({ this->Positions.bytes() }));
  this->Positions.clear();
  this->VertexRows.clear();
}

void VsmWriter::flushLast()
{
  packIntegers(this->LastRows, this->Packed);
  const std::span<const std::byte> column = this->Packed;
  this->File.append(VsmFormat::Last, std::int64_t(this->LastRows.size()), { &column, 1 });
  this->LastRows.clear();
  this->PreviousLast = 0;
}

void VsmWriter::flushCells()
{
  packIntegers(this->Distances, this->Packed);
  this->File.append(VsmFormat::Cells, std::int64_t(this->Distances.size()) / this->Corners,
    this->CellRows.block({ this->Packed }));
  this->Distances.clear();
  this->CellRows.clear();
}

void VsmWriter::writeBlockTable()
{
  this->Finalized.resize(this->FirstVertex.size(), this->Info.vertices);
  const std::span<const std::byte> columns[] = { std::as_bytes(std::span(this->FirstVertex)),
    std::as_bytes(std::span(this->Finalized)) };
  this->File.append(VsmFormat::Blocks, std::int64_t(this->FirstVertex.size()), columns);
}

void VsmWriter::isolated(std::span<const std::int64_t> ids, std::span<const double> positions,
  const std::vector<Column>& columns)
{
  this->Isolated.append(this->File, ids, positions, columns);
}

void VsmWriter::writeGroups()
{
  if (this->Info.groups.empty())
  {
    return;
  }
  const std::string text = textOf(this->Info.groups);
  if (std::ssize(text) > MaxGroupTextBytes)
  {
    this->fail("the groups of the mesh take " + mebibytes(std::ssize(text)) +
               ", but a file has room for " + mebibytes(MaxGroupTextBytes) +
               ": leave some out, or give them shorter names.");
  }
  const std::span<const std::byte> column = std::as_bytes(std::span(text));
  this->File.append(VsmFormat::Groups, 1, { &column, 1 });
}

StreamInfo VsmWriter::finish(const std::string& origin)
{
  StreamInfo& info = this->Info;
  if (info.cells == 0)
  {
    this->fail("a mesh without cells cannot be written.");
  }
  if (this->Introduced < info.vertices)
  {
    this->fail("vertex " + std::to_string(this->Introduced) +
               " belongs to no cell: leave out such vertices.");
  }
  this->settle(info.vertices);
  if (info.vertices % this->Rows.vertices != 0)
  {
    this->flushVertices();
  }
  if (info.vertices % VsmFormat::BlockRows != 0)
  {
    this->flushLast();
  }
  if (info.cells % this->Rows.cells != 0)
  {
    this->flushCells();
  }
  this->writeBlockTable();
  this->Isolated.finish(this->File);
  this->writeGroups();
  const StreamStatistics::Result alive = this->Statistics.result();
  info.width = alive.width;
  this->MeanWidth = alive.mean;
  nlohmann::json header = { { "kind", VsmFormat::Kind },
    { "cell", info.cellType == CellType::Triangle ? "triangle" : "tetrahedron" },
    { "precision", info.doublePositions ? "float64" : "float32" }, { "vertices", info.vertices },
    { "cells", info.cells }, { "bounds", info.bounds }, { "width", info.width },
    { "span", info.span }, { "mean_width", alive.mean } };
  if (!origin.empty())
  {
    header["origin"] = origin;
  }
  this->File.finish(header.dump());
  return info;
}

} // namespace smg
