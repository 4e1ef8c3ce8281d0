// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmFile.h"

#include "IO/External/BlockFile.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Vsm/PackedIntegers.h"
#include "IO/Formats/Vsm/VsmBuffers.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/GroupsJson.h"
#include "Solver/Core/Progress.h"
#include "Solver/Core/Text.h"
#include "Solver/Memory/Pool.h"
#include "smg/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace smg
{
RowReader::RowReader(BlockFileReader& file, int table, int column)
  : File(&file)
  , Table(table)
  , Column(column)
  , TupleBytes(file.tables()[table].columns[column].tupleBytes())
{
}

void RowReader::load(std::int64_t block)
{
  if (block != this->Block)
  {
    this->Block = -1;
    this->Bytes.resize(this->File->columnBytes(this->Table, block, this->Column));
    this->File->read(this->Table, block, this->Column, this->Bytes);
    this->Block = block;
  }
}

void RowReader::read(std::int64_t first, std::int64_t count, std::byte* values)
{
  while (count > 0)
  {
    const std::int64_t block = this->File->blockOf(this->Table, first);
    this->load(block);
    const std::int64_t begin = first - this->File->firstRow(this->Table, block);
    const std::int64_t n = std::min(count, this->File->blockRows(this->Table, block) - begin);
    std::memcpy(values, this->Bytes.data() + begin * this->TupleBytes, n * this->TupleBytes);
    values += n * this->TupleBytes;
    first += n;
    count -= n;
  }
}

void RowReader::gather(std::span<const std::int64_t> rows, std::byte* values)
{
  std::int64_t begin = 0;
  std::int64_t end = 0;
  for (const std::int64_t row : rows)
  {
    if (row < begin || row >= end)
    {
      const std::int64_t block = this->File->blockOf(this->Table, row);
      this->load(block);
      begin = this->File->firstRow(this->Table, block);
      end = begin + this->File->blockRows(this->Table, block);
    }
    std::memcpy(values, this->Bytes.data() + (row - begin) * this->TupleBytes, this->TupleBytes);
    values += this->TupleBytes;
  }
}

VsmFile::VsmFile(
  const std::filesystem::path& path, IoStatistics* statistics, const std::string& fingerprint)
  : Blocks(path, statistics)
  , Name(path.string())
{
  // The index that is read again has the checksums of all blocks: a file that changes later is
  // found when they are read.
  if (!fingerprint.empty() && this->fingerprint() != fingerprint)
  {
    this->fail("is another mesh than before: it was replaced or changed while it was in use; run "
               "this again, and leave the file as it is meanwhile.");
  }
  this->readHeader();
  this->readTables();
  this->readBlockTable();
}

void VsmFile::fail(const std::string& what) const
{
  throw Error(oneLine(this->Name + ": " + what));
}

void VsmFile::failForMemory(const std::string& what) const
{
  throw MemoryError(oneLine(this->Name + ": " + what));
}

namespace
{

/** An integer of the header in [least, most]. Throws what the JSON library throws, or a sentence.
 */
std::int64_t integerIn(
  const nlohmann::json& header, const char* key, std::int64_t least, std::int64_t most)
{
  const nlohmann::json& value = header.at(key);
  // A number of another type would be converted without a word.
  const bool isSigned =
    value.is_number_integer() &&
    (!value.is_number_unsigned() || value.get<std::uint64_t>() <= std::uint64_t(INT64_MAX));
  const std::int64_t number = isSigned ? value.get<std::int64_t>() : -1;
  if (!isSigned || number < least || number > most)
  {
    throw MeshError("says that its " + std::string(key) + " is " + value.dump() + ", not from " +
                    std::to_string(least) + " to " + std::to_string(most));
  }
  return number;
}

/** The bounds of the vertices: finite, and the smaller one first. */
std::array<double, 6> boundsOf(const nlohmann::json& header)
{
  const nlohmann::json& value = header.at("bounds");
  std::array<double, 6> bounds{};
  bool good = value.is_array() && value.size() == bounds.size();
  for (std::size_t i = 0; good && i < bounds.size(); ++i)
  {
    bounds[i] = value[i].get<double>();
    good = std::isfinite(bounds[i]) && (i % 2 == 0 || bounds[i - 1] <= bounds[i]);
  }
  if (!good)
  {
    throw MeshError("says that its bounds are " + value.dump() +
                    ", not six numbers xmin, xmax, ymin, ymax, zmin, zmax");
  }
  return bounds;
}

/** Reads a block as a whole, which checks it. */
void readBlock(BlockFileReader& file, int table, std::int64_t block, std::vector<std::byte>& bytes)
{
  const auto columns =
    static_cast<int>(file.tables()[static_cast<std::size_t>(table)].columns.size());
  for (int column = 0; column < columns; ++column)
  {
    bytes.resize(file.columnBytes(table, block, column));
    file.read(table, block, column, bytes);
  }
}

} // namespace

void VsmFile::readHeader()
{
  const nlohmann::json header = nlohmann::json::parse(this->Blocks.header());
  if (!header.is_object() || header.value("kind", nlohmann::json()) != VsmFormat::Kind)
  {
    this->fail("is a block file, but not a mesh stream.");
  }
  try
  {
    constexpr std::int64_t Most = INT64_MAX;
    const std::string cell = header.at("cell");
    const std::string precision = header.at("precision");
    if ((cell != "triangle" && cell != "tetrahedron") ||
        (precision != "float32" && precision != "float64"))
    {
      this->fail("has cells or coordinates of an unknown kind: " + cell + ", " + precision + ".");
    }
    this->Info.cellType = cell == "triangle" ? CellType::Triangle : CellType::Tetrahedron;
    this->Info.doublePositions = precision == "float64";
    this->Info.vertices = integerIn(header, "vertices", 1, Most);
    this->Info.cells = integerIn(header, "cells", 1, Most);
    this->Info.bounds = boundsOf(header);
    // Whoever reads the stream sizes windows by these.
    this->Info.width = integerIn(header, "width", 1, this->Info.vertices);
    this->Info.span = integerIn(header, "span", 0, this->Info.vertices - 1);
    this->MeanWidth = header.at("mean_width").get<double>();
    if (!(this->MeanWidth >= 0.0 && this->MeanWidth <= static_cast<double>(this->Info.width)))
    {
      throw MeshError("says that its mean_width is " + header.at("mean_width").dump() +
                      ", not from 0 to its width");
    }
    if (header.contains("groups"))
    {
      this->Info.groups = groupsOf(header);
    }
  }
  catch (const MeshError& error)
  {
    this->fail(std::string(error.what()) + "; make it anew.");
  }
  catch (const nlohmann::json::exception& error)
  {
    this->fail(std::string("has an incomplete header (") + error.what() + "); make it anew.");
  }
}

void VsmFile::readTables()
{
  const std::vector<TableSpec>& tables = this->Blocks.tables();
  const auto first = [&](int table) -> ColumnSpec
  { return tables[table].columns.empty() ? ColumnSpec{} : tables[table].columns[0]; };
  const ScalarType real = positionType(this->Info.doublePositions);
  const std::vector<ColumnSpec> blockColumns{ { "FirstVertex", ScalarType::Int64, 1 },
    { "Finalized", ScalarType::Int64, 1 } };
  const std::size_t most = VsmFormat::Groups + 1;
  if (tables.size() < VsmFormat::MinTables || tables.size() > most ||
      first(VsmFormat::Vertices) != ColumnSpec{ "Position", real, 3 } ||
      first(VsmFormat::Last) != ColumnSpec{ "LastCell", ScalarType::UInt8, 0 } ||
      first(VsmFormat::Cells) != ColumnSpec{ "Corners", ScalarType::UInt8, 0 } ||
      tables[VsmFormat::Blocks].columns != blockColumns)
  {
    this->fail("does not have the tables of a mesh stream; make it anew.");
  }
  const BlockFileReader& blocks = this->Blocks;
  const bool good = blocks.rows(VsmFormat::Vertices) == this->Info.vertices &&
                    blocks.rows(VsmFormat::Last) == this->Info.vertices &&
                    blocks.rows(VsmFormat::Cells) == this->Info.cells &&
                    blocks.rows(VsmFormat::Blocks) == blocks.blocks(VsmFormat::Cells) &&
                    this->Info.cells > 0;
  if (!good)
  {
    this->fail("has tables that are not as long as the header says; make it anew.");
  }
  const auto attributes = [&](int table)
  { return std::vector(tables[table].columns.begin() + 1, tables[table].columns.end()); };
  this->Info.vertexColumns = attributes(VsmFormat::Vertices);
  this->Info.cellColumns = attributes(VsmFormat::Cells);
  this->HasIsolated = tables.size() > VsmFormat::Isolated;
  if (this->HasIsolated && tables[VsmFormat::Isolated] != IsolatedWriter::table(this->Info))
  {
    this->fail("has isolated vertices that are not like the others; make it anew.");
  }
  this->checkBlocks();
  if (tables.size() > VsmFormat::Groups)
  {
    this->readGroups();
  }
  this->checkColumns();
}

void VsmFile::readGroups()
{
  BlockFileReader& blocks = this->Blocks;
  if (blocks.tables()[VsmFormat::Groups] != groupTable() || blocks.rows(VsmFormat::Groups) != 1 ||
      blocks.columnBytes(VsmFormat::Groups, 0, 0) > std::size_t(MaxGroupTextBytes))
  {
    this->fail("has a table of groups that is not one text; make it anew.");
  }
  std::string text(blocks.columnBytes(VsmFormat::Groups, 0, 0), '\0');
  blocks.read(VsmFormat::Groups, 0, 0, std::as_writable_bytes(std::span(text)));
  try
  {
    this->Info.groups = groupsOfText(text);
  }
  catch (const MeshError& error)
  {
    this->fail(std::string(error.what()) + "; make it anew.");
  }
}

/** Blocks are read as a whole: what takes no room in the file must not take all memory. */
void VsmFile::checkBlocks() const
{
  const int tables = static_cast<int>(this->Blocks.tables().size());
  for (int table = 0; table < tables; ++table)
  {
    const std::int64_t packed = table == VsmFormat::Last    ? 1
                                : table == VsmFormat::Cells ? cornersOf(this->Info.cellType)
                                                            : 0;
    // The table of blocks has as many rows as the index of the cells has entries.
    const std::int64_t blocks = table == VsmFormat::Blocks ? 0 : this->Blocks.blocks(table);
    for (std::int64_t b = 0; b < blocks; ++b)
    {
      const std::int64_t rows = this->Blocks.blockRows(table, b);
      if (rows < 1 || rows > VsmFormat::BlockRows ||
          (packed > 0 &&
            this->Blocks.columnBytes(table, b, 0) > maxPackedBytes(std::size_t(rows * packed))))
      {
        this->fail("table '" + this->Blocks.tables()[table].name + "', block " + std::to_string(b) +
                   " is empty or too large; make the file anew.");
      }
    }
  }
}

void VsmFile::checkColumns() const
{
  for (const auto* columns : { &this->Info.vertexColumns, &this->Info.cellColumns })
  {
    std::set<std::string> names;
    for (const ColumnSpec& column : *columns)
    {
      if (column.components < 1 || column.name.empty() || isReservedColumn(column.name) ||
          !names.insert(column.name).second)
      {
        this->fail("has a column '" + column.name +
                   "' without components or a name of its own; make it anew.");
      }
    }
    if (names.size() > VsmFormat::MaxColumns)
    {
      this->fail("has " + std::to_string(names.size()) + " columns, but may have " +
                 std::to_string(VsmFormat::MaxColumns) + "; make it anew.");
    }
  }
  this->checkGroups();
  if (std::any_of(this->Info.cellColumns.begin(), this->Info.cellColumns.end(),
        [](const ColumnSpec& column)
        {
          return column.name == CellFlagsName &&
                 column != ColumnSpec{ CellFlagsName, ScalarType::UInt8, 1 };
        }))
  {
    this->fail("has a column CellFlags that is not of one uint8 a cell; make it anew.");
  }
}

/** Columns of groups go with the groups. */
void VsmFile::checkGroups() const
{
  for (const auto* columns : { &this->Info.vertexColumns, &this->Info.cellColumns })
  {
    for (const ColumnSpec& column : *columns)
    {
      const bool ofVertices = columns == &this->Info.vertexColumns;
      if (isGroupColumn(column.name) &&
          (this->Info.groups.empty() ||
            !MeshGroups::isOfMesh(column, ofVertices, cornersOf(this->Info.cellType))))
      {
        this->fail(
          "has a column '" + column.name + "' that does not go with its groups; make it anew.");
      }
    }
  }
}

void VsmFile::readBlockTable()
{
  const std::int64_t count = this->cellBlocks();
  this->FirstVertex.resize(count);
  this->Finalized.resize(count);
  RowReader(this->Blocks, VsmFormat::Blocks, 0)
    .read(0, count, reinterpret_cast<std::byte*>(this->FirstVertex.data()));
  RowReader(this->Blocks, VsmFormat::Blocks, 1)
    .read(0, count, reinterpret_cast<std::byte*>(this->Finalized.data()));
  this->FirstVertex.push_back(this->Info.vertices);
  bool good = this->FirstVertex[0] == 0 && this->Finalized[count - 1] == this->Info.vertices;
  for (std::int64_t b = 0; b < count; b++)
  {
    good = good && this->FirstVertex[b] <= this->FirstVertex[b + 1] && this->Finalized[b] >= 0 &&
           this->Finalized[b] <= this->FirstVertex[b + 1] &&
           (b == 0 || this->Finalized[b - 1] <= this->Finalized[b]);
  }
  if (!good)
  {
    this->fail("has a table of blocks that makes no sense; make it anew.");
  }
}

std::int64_t VsmFile::blockBytes() const
{
  const auto bytesOf = [this](int table, std::int64_t block)
  {
    const auto columns = static_cast<int>(this->Blocks.tables()[table].columns.size());
    std::int64_t bytes = 0;
    for (int column = 0; column < columns; ++column)
    {
      bytes += static_cast<std::int64_t>(this->Blocks.columnBytes(table, block, column));
    }
    return bytes;
  };
  const std::int64_t ofVertex = rowBytes(this->Info.vertexColumns);
  std::int64_t vertices = 0, cells = 0, delivered = 0;
  for (std::int64_t b = 0; b < this->Blocks.blocks(VsmFormat::Vertices); ++b)
  {
    vertices = std::max(vertices, bytesOf(VsmFormat::Vertices, b));
  }
  for (std::int64_t b = 0; b < this->cellBlocks(); ++b)
  {
    const std::int64_t bytes = bytesOf(VsmFormat::Cells, b);
    cells = std::max(cells, bytes);
    // No more than its corners: what the table says otherwise is refused when the block is read.
    const std::int64_t introduced = std::min(this->firstVertex(b + 1) - this->firstVertex(b),
      this->Blocks.blockRows(VsmFormat::Cells, b) * cornersOf(this->Info.cellType));
    delivered = std::max(delivered, bytes + introduced * ofVertex);
  }
  return vertices + cells + delivered;
}

void VsmFile::readPacked(int table, std::int64_t block, std::size_t count)
{
  this->Packed.resize(this->Blocks.columnBytes(table, block, 0));
  this->Blocks.read(table, block, 0, this->Packed);
  this->Numbers.resize(count);
  if (!unpackIntegers(this->Packed, this->Numbers))
  {
    this->fail("table '" + this->Blocks.tables()[table].name + "', block " + std::to_string(block) +
               " has not the right length; make the file anew.");
  }
}

void VsmFile::readCorners(std::int64_t block, std::vector<std::int64_t>& corners)
{
  const std::int64_t rows = this->Blocks.blockRows(VsmFormat::Cells, block);
  this->readPacked(VsmFormat::Cells, block, rows * cornersOf(this->Info.cellType));
  corners.resize(this->Numbers.size());
  // What no later cell uses may be forgotten by now.
  const std::int64_t least = block > 0 ? this->Finalized[block - 1] : 0;
  std::int64_t introduced = this->FirstVertex[block];
  bool good = true;
  for (std::size_t i = 0; i < corners.size(); i++)
  {
    const auto distance = static_cast<std::int64_t>(this->Numbers[i]);
    good = good && distance >= 0 && distance <= introduced - least;
    corners[i] = introduced - distance;
    introduced += distance == 0 ? 1 : 0;
  }
  if (!good || introduced != this->FirstVertex[block + 1])
  {
    this->fail("block " + std::to_string(block) +
               " of the cells does not go with its vertices; make the file anew.");
  }
}

void VsmFile::readLastCells(std::int64_t block, std::vector<std::int64_t>& cells)
{
  this->readPacked(VsmFormat::Last, block, this->Blocks.blockRows(VsmFormat::Last, block));
  cells.resize(this->Numbers.size());
  std::uint64_t last = 0;
  bool good = true;
  for (std::size_t i = 0; i < cells.size(); i++)
  {
    last += static_cast<std::uint64_t>(unzigzag(this->Numbers[i]));
    cells[i] = static_cast<std::int64_t>(last);
    good = good && cells[i] >= 0 && cells[i] < this->Info.cells;
  }
  if (!good)
  {
    this->fail("block " + std::to_string(block) +
               " of the last cells of vertices names a cell that does not exist; make the file "
               "anew.");
  }
}

int VsmFile::find(
  const std::vector<ColumnSpec>& columns, const std::string& name, const char* kind) const
{
  std::string known;
  for (std::size_t c = 0; c < columns.size(); c++)
  {
    if (columns[c].name == name)
    {
      return static_cast<int>(c) + 1;
    }
    known += (c > 0 ? ", '" : " '") + columns[c].name + "'";
  }
  this->fail(std::string("has no ") + kind + " column '" + name + "'; it has" +
             (known.empty() ? " none." : known + "."));
}

std::int64_t checkVsm(const std::filesystem::path& path, const ProgressFunction& progress)
{
  BlockFileReader file(path);
  const auto tables = static_cast<int>(file.tables().size());
  std::int64_t blocks = 0;
  for (int table = 0; table < tables; ++table)
  {
    blocks += file.blocks(table);
  }
  Progress reported(progress);
  std::vector<std::byte> bytes;
  std::int64_t done = 0;
  for (int table = 0; table < tables; ++table)
  {
    for (std::int64_t block = 0; block < file.blocks(table); ++block)
    {
      readBlock(file, table, block, bytes);
      reported.update(static_cast<double>(++done) / static_cast<double>(blocks));
    }
  }
  return blocks;
}

} // namespace smg
