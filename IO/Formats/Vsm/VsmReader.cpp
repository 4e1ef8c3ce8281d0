// SPDX-License-Identifier: BSD-3-Clause
#include "smg/VsmReader.h"
#include "IO/Formats/Vsm/PieceReader.h"
#include "IO/Formats/Vsm/VsmFile.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** Delivers a .vsm file as a mesh stream, one block of the cells at a time. */
class VsmSource : public MeshSource
{
public:
  VsmSource(const std::filesystem::path& path, const std::vector<std::string>& vertexColumns,
    const std::vector<std::string>& cellColumns, IoStatistics* statistics,
    const std::string& fingerprint)
    : File(path, statistics, fingerprint)
    , Info(this->File.Info)
    , Positions(this->File)
  {
    this->Info.vertexColumns.clear();
    for (const std::string& name : vertexColumns)
    {
      const int column = this->File.vertexColumn(name);
      this->VertexColumns.emplace_back(this->File.Blocks, VsmFormat::Vertices, column);
      this->Info.vertexColumns.push_back(this->File.Info.vertexColumns[column - 1]);
    }
    this->Info.cellColumns.clear();
    for (const std::string& name : cellColumns)
    {
      const int column = this->File.cellColumn(name);
      this->CellColumns.emplace_back(this->File.Blocks, VsmFormat::Cells, column);
      this->Info.cellColumns.push_back(this->File.Info.cellColumns[column - 1]);
    }
    this->prefetch(0);
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    if (this->Next >= this->File.cellBlocks())
    {
      return false;
    }
    const std::int64_t b = this->Next++;
    this->prefetch(b + 1);
    this->File.readCorners(b, block.corners);
    block.firstCell = this->File.Blocks.firstRow(VsmFormat::Cells, b);
    const std::int64_t cells = this->File.Blocks.blockRows(VsmFormat::Cells, b);
    this->readColumns(
      this->CellColumns, this->Info.cellColumns, block.firstCell, cells, block.cellColumns);

    block.firstVertex = this->File.firstVertex(b);
    const std::int64_t vertices = this->File.firstVertex(b + 1) - block.firstVertex;
    block.positions.resize(3 * vertices);
    this->Positions.read(block.firstVertex, vertices, block.positions.data());
    this->readColumns(this->VertexColumns, this->Info.vertexColumns, block.firstVertex, vertices,
      block.vertexColumns);
    block.finalized = this->File.finalized(b);
    return true;
  }

  bool readsOnAnyThread() const override { return true; }

private:
  /** Requests a block of the cells and the vertices that it introduces. */
  void prefetch(std::int64_t block)
  {
    BlockFileReader& blocks = this->File.Blocks;
    if (block >= this->File.cellBlocks())
    {
      return;
    }
    blocks.prefetch(VsmFormat::Cells, block);
    const std::int64_t end = this->File.firstVertex(block + 1);
    while (this->PrefetchedVertex < blocks.blocks(VsmFormat::Vertices) &&
           blocks.firstRow(VsmFormat::Vertices, this->PrefetchedVertex) < end)
    {
      blocks.prefetch(VsmFormat::Vertices, this->PrefetchedVertex++);
    }
  }

  void readColumns(std::vector<RowReader>& readers, const std::vector<ColumnSpec>& specs,
    std::int64_t first, std::int64_t count, std::vector<Column>& columns)
  {
    columns.resize(specs.size());
    for (std::size_t c = 0; c < specs.size(); c++)
    {
      columns[c].spec = specs[c];
      columns[c].resize(count);
      readers[c].read(first, count, columns[c].bytes.data());
    }
  }

  VsmFile File;
  StreamInfo Info;
  PositionReader Positions;
  std::vector<RowReader> VertexColumns, CellColumns;
  std::int64_t Next = 0;             ///< block of the cells
  std::int64_t PrefetchedVertex = 0; ///< first block of the vertices not asked for yet
};

namespace
{

/** The chosen columns of the cells, and always their flags. */
std::vector<std::string> withFlags(
  std::vector<std::string> chosen, const std::vector<ColumnSpec>& columns)
{
  const bool given = std::find(chosen.begin(), chosen.end(), CellFlagsName) != chosen.end();
  const bool there = std::any_of(columns.begin(), columns.end(),
    [](const ColumnSpec& column) { return column.name == CellFlagsName; });
  if (there && !given)
  {
    chosen.emplace_back(CellFlagsName);
  }
  return chosen;
}

} // namespace

struct VsmReader::Implementation
{
  Implementation(
    std::filesystem::path path, IoStatistics* statistics, const std::string& fingerprint)
    : Path(std::move(path))
    , Statistics(statistics)
    , File(this->Path, statistics, fingerprint)
    , LastCells(this->File)
  {
  }

  void checkVertices(std::int64_t first, std::int64_t count) const
  {
    if (first < 0 || count < 0 || first > this->File.Info.vertices - count)
    {
      this->File.fail("has no " + std::to_string(count) + " vertices from " +
                      std::to_string(first) + " on, but " +
                      std::to_string(this->File.Info.vertices) + " in all.");
    }
  }

  std::filesystem::path Path;
  IoStatistics* Statistics;
  VsmFile File;
  LastCellReader LastCells;
  std::unique_ptr<PieceReader> Pieces; ///< made when the columns are chosen or a piece is read
};

VsmReader::VsmReader(
  std::filesystem::path path, IoStatistics* statistics, const std::string& fingerprint)
  : Self(std::make_unique<Implementation>(std::move(path), statistics, fingerprint))
{
}

VsmReader::~VsmReader() = default;

const std::filesystem::path& VsmReader::path() const
{
  return this->Self->Path;
}

const StreamInfo& VsmReader::info() const
{
  return this->Self->File.Info;
}

double VsmReader::meanWidth() const
{
  return this->Self->File.MeanWidth;
}

const std::string& VsmReader::header() const
{
  return this->Self->File.Blocks.header();
}

Codec VsmReader::codec() const
{
  return this->Self->File.Blocks.codec();
}

std::string VsmReader::fingerprint() const
{
  return this->Self->File.fingerprint();
}

void VsmReader::requireBlocksWithin(std::int64_t memory) const
{
  const std::int64_t index = this->Self->File.Blocks.indexBytes();
  const std::int64_t blocks = this->Self->File.blockBytes();
  constexpr std::int64_t Most = INT64_MAX - MaxIndexBytes;
  const std::int64_t needed =
    index + (blocks > Most / VsmFormat::BlocksInUse ? Most : VsmFormat::BlocksInUse * blocks);
  // As much is not accounted for; what computes with a limit below it says what it needs.
  constexpr std::int64_t Usual = std::int64_t(4) << 20;
  if (needed > std::max(memory, Usual))
  {
    this->Self->File.failForMemory(
      "its columns are so wide or so many that reading it takes " + mebibytes(needed) +
      ", but the memory limit is " + mebibytes(memory) +
      ": raise it, or convert the original mesh anew, without columns that are not needed.");
  }
}

std::int64_t VsmReader::vertexBlocks() const
{
  return this->Self->File.Blocks.blocks(VsmFormat::Vertices);
}

std::int64_t VsmReader::cellBlocks() const
{
  return this->Self->File.cellBlocks();
}

std::int64_t VsmReader::storedBytes() const
{
  return static_cast<std::int64_t>(std::filesystem::file_size(this->Self->Path));
}

std::int64_t VsmReader::plainBytes() const
{
  const BlockFileReader& blocks = this->Self->File.Blocks;
  std::int64_t bytes = 0;
  for (int table = 0; table < static_cast<int>(blocks.tables().size()); table++)
  {
    const int columns = static_cast<int>(blocks.tables()[table].columns.size());
    for (std::int64_t block = 0; block < blocks.blocks(table); block++)
    {
      for (int column = 0; column < columns; column++)
      {
        bytes += static_cast<std::int64_t>(blocks.columnBytes(table, block, column));
      }
    }
  }
  return bytes;
}

std::unique_ptr<MeshSource> VsmReader::source() const
{
  const StreamInfo& info = this->info();
  return this->source(columnNames(info.vertexColumns), columnNames(info.cellColumns));
}

std::unique_ptr<MeshSource> VsmReader::source(
  std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const
{
  return std::make_unique<VsmSource>(this->Self->Path, vertexColumns,
    withFlags(std::move(cellColumns), this->info().cellColumns), this->Self->Statistics,
    this->fingerprint());
}

void VsmReader::selectColumns(
  const std::vector<std::string>& vertexColumns, const std::vector<std::string>& cellColumns)
{
  this->Self->Pieces = std::make_unique<PieceReader>(
    this->Self->File, vertexColumns, withFlags(cellColumns, this->info().cellColumns));
}

void VsmReader::readPiece(
  std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece, int ghostLevels)
{
  Implementation& self = *this->Self;
  if (!self.Pieces)
  {
    this->selectColumns(
      columnNames(self.File.Info.vertexColumns), columnNames(self.File.Info.cellColumns));
  }
  self.Pieces->read(firstCell, endCell, piece);
  if (ghostLevels > 0)
  {
    self.Pieces->addGhosts(firstCell, endCell, ghostLevels, piece);
  }
}

void VsmReader::readVertexColumn(
  const std::string& name, std::int64_t first, std::int64_t count, Column& column)
{
  Implementation& self = *this->Self;
  const int number = self.File.vertexColumn(name);
  self.checkVertices(first, count);
  column.spec = self.File.Info.vertexColumns[number - 1];
  column.resize(count);
  RowReader(self.File.Blocks, VsmFormat::Vertices, number).read(first, count, column.bytes.data());
}

void VsmReader::readLastCells(std::int64_t first, std::span<std::int64_t> cells)
{
  this->Self->checkVertices(first, static_cast<std::int64_t>(cells.size()));
  this->Self->LastCells.read(first, cells);
}

std::int64_t VsmReader::isolatedVertices() const
{
  return this->Self->File.isolatedVertices();
}

void VsmReader::readIsolated(std::int64_t first, std::int64_t count, IsolatedVertices& vertices)
{
  VsmFile& file = this->Self->File;
  if (first < 0 || count < 0 || first > file.isolatedVertices() - count)
  {
    file.fail("has no " + std::to_string(count) + " isolated vertices from " +
              std::to_string(first) + " on, but " + std::to_string(file.isolatedVertices()) +
              " in all.");
  }
  vertices.ids.resize(static_cast<std::size_t>(count));
  vertices.positions.resize(static_cast<std::size_t>(3 * count));
  vertices.columns = emptyColumns(file.Info.vertexColumns);
  if (count == 0)
  {
    return;
  }
  RowReader(file.Blocks, VsmFormat::Isolated, 0)
    .read(first, count, reinterpret_cast<std::byte*>(vertices.ids.data()));
  PositionReader(file, VsmFormat::Isolated, 1).read(first, count, vertices.positions.data());
  int number = 2;
  for (Column& column : vertices.columns)
  {
    column.resize(static_cast<std::size_t>(count));
    RowReader(file.Blocks, VsmFormat::Isolated, number++).read(first, count, column.bytes.data());
  }
}

} // namespace smg
