// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/PieceReader.h"

#include <algorithm>
#include <numeric>

namespace smg
{

void VertexRows::reset(const std::vector<ColumnSpec>& specs)
{
  this->ids.clear();
  this->positions.clear();
  this->lastCells.clear();
  this->columns.resize(specs.size());
  for (std::size_t c = 0; c < specs.size(); c++)
  {
    this->columns[c].spec = specs[c];
    this->columns[c].bytes.clear();
  }
}

void VertexRows::append(const VertexRows& other, std::int64_t row)
{
  this->ids.push_back(other.ids[row]);
  const double* const position = &other.positions[3 * row];
  this->positions.insert(this->positions.end(), position, position + 3);
  this->lastCells.push_back(other.lastCells[row]);
  for (std::size_t c = 0; c < this->columns.size(); c++)
  {
    const auto tuple = static_cast<std::int64_t>(this->columns[c].spec.tupleBytes());
    const auto from = other.columns[c].bytes.begin() + row * tuple;
    this->columns[c].bytes.insert(this->columns[c].bytes.end(), from, from + tuple);
  }
}

void LastCellReader::load(std::int64_t vertex)
{
  const std::int64_t offset = vertex - this->First;
  if (offset < 0 || offset >= static_cast<std::int64_t>(this->Cells.size()))
  {
    const BlockFileReader& blocks = this->File->Blocks;
    const std::int64_t block = blocks.blockOf(VsmFormat::Last, vertex);
    this->Cells.clear();
    this->File->readLastCells(block, this->Cells);
    this->First = blocks.firstRow(VsmFormat::Last, block);
  }
}

void LastCellReader::read(std::int64_t first, std::span<std::int64_t> cells)
{
  while (!cells.empty())
  {
    this->load(first);
    const std::size_t begin = first - this->First;
    const std::size_t n = std::min(cells.size(), this->Cells.size() - begin);
    std::copy_n(this->Cells.begin() + std::int64_t(begin), n, cells.begin());
    cells = cells.subspan(n);
    first += std::int64_t(n);
  }
}

void LastCellReader::gather(std::span<const std::int64_t> vertices, std::int64_t* cells)
{
  for (const std::int64_t vertex : vertices)
  {
    this->load(vertex);
    *cells++ = this->Cells[vertex - this->First];
  }
}

VertexReader::VertexReader(VsmFile& file, const std::vector<int>& columns)
  : Positions(file)
  , LastCells(file)
{
  for (const int column : columns)
  {
    this->Columns.emplace_back(file.Blocks, VsmFormat::Vertices, column);
  }
}

std::int64_t VertexReader::grow(VertexRows& rows, std::int64_t count)
{
  const std::int64_t size = rows.size();
  rows.ids.resize(size + count);
  rows.positions.resize(3 * (size + count));
  rows.lastCells.resize(size + count);
  for (Column& column : rows.columns)
  {
    column.resize(size + count);
  }
  return size;
}

void VertexReader::read(std::int64_t first, std::int64_t count, VertexRows& rows)
{
  const std::int64_t at = grow(rows, count);
  std::iota(rows.ids.begin() + at, rows.ids.end(), first);
  this->Positions.read(first, count, rows.positions.data() + 3 * at);
  this->LastCells.read(first, std::span(rows.lastCells).subspan(at));
  for (std::size_t c = 0; c < this->Columns.size(); c++)
  {
    RowReader& reader = this->Columns[c];
    reader.read(first, count, rows.columns[c].bytes.data() + at * reader.tupleBytes());
  }
}

void VertexReader::gather(std::span<const std::int64_t> vertices, VertexRows& rows)
{
  const std::int64_t at = grow(rows, static_cast<std::int64_t>(vertices.size()));
  std::copy(vertices.begin(), vertices.end(), rows.ids.begin() + at);
  this->Positions.gather(vertices, rows.positions.data() + 3 * at);
  this->LastCells.gather(vertices, rows.lastCells.data() + at);
  for (std::size_t c = 0; c < this->Columns.size(); c++)
  {
    RowReader& reader = this->Columns[c];
    reader.gather(vertices, rows.columns[c].bytes.data() + at * reader.tupleBytes());
  }
}

namespace
{

std::vector<int> vertexNumbers(const VsmFile& file, const std::vector<std::string>& names)
{
  std::vector<int> numbers;
  for (const std::string& name : names)
  {
    numbers.push_back(file.vertexColumn(name));
  }
  return numbers;
}

} // namespace

PieceReader::PieceReader(VsmFile& file, const std::vector<std::string>& vertexColumns,
  const std::vector<std::string>& cellColumns)
  : File(file)
  , Corners(cornersOf(file.Info.cellType))
  , InOrder(file, vertexNumbers(file, vertexColumns))
  , Anywhere(file, vertexNumbers(file, vertexColumns))
  , LastCells(file)
{
  for (const int column : vertexNumbers(file, vertexColumns))
  {
    this->VertexSpecs.push_back(file.Info.vertexColumns[column - 1]);
  }
  for (const std::string& name : cellColumns)
  {
    const int column = file.cellColumn(name);
    this->CellSpecs.push_back(file.Info.cellColumns[column - 1]);
    this->CellColumns.emplace_back(file.Blocks, VsmFormat::Cells, column);
  }
  this->Alive.reset(this->VertexSpecs);
}

void PieceReader::read(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece)
{
  if (firstCell < 0 || endCell < firstCell || endCell > this->File.Info.cells)
  {
    this->File.fail("has no cells from " + std::to_string(firstCell) + " to " +
                    std::to_string(endCell) + ", but " + std::to_string(this->File.Info.cells) +
                    " in all.");
  }
  // In this order, so that the blocks of the cells at both ends are read once.
  const std::int64_t begin = firstCell < endCell ? this->introducedBefore(firstCell) : 0;
  this->readCells(firstCell, endCell, piece);
  const std::int64_t end = firstCell < endCell ? this->introducedBefore(endCell) : 0;

  this->Ghosts.clear();
  std::copy_if(piece.corners.begin(), piece.corners.end(), std::back_inserter(this->Ghosts),
    [begin](std::int64_t v) { return v < begin; });
  std::sort(this->Ghosts.begin(), this->Ghosts.end());
  this->Ghosts.erase(std::unique(this->Ghosts.begin(), this->Ghosts.end()), this->Ghosts.end());
  const auto ghosts = static_cast<std::int64_t>(this->Ghosts.size());
  for (std::int64_t& v : piece.corners)
  {
    v = v >= begin
          ? ghosts + v - begin
          : std::lower_bound(this->Ghosts.begin(), this->Ghosts.end(), v) - this->Ghosts.begin();
  }

  this->collect(this->Ghosts, begin, end);
  if (firstCell < endCell)
  {
    this->remember(end, endCell);
  }
  piece.firstCell = firstCell;
  piece.ghostCells.clear();
  piece.ghost.assign(this->Rows.size(), 0);
  std::fill_n(piece.ghost.begin(), ghosts, 1);
  piece.finalized.resize(this->Rows.size());
  std::transform(this->Rows.lastCells.begin(), this->Rows.lastCells.end(), piece.finalized.begin(),
    [endCell](std::int64_t last) { return last < endCell ? 1 : 0; });
  std::swap(piece.ids, this->Rows.ids);
  std::swap(piece.positions, this->Rows.positions);
  std::swap(piece.vertexColumns, this->Rows.columns);
}

void PieceReader::addGhosts(
  std::int64_t firstCell, std::int64_t endCell, int levels, MeshPiece& piece)
{
  const std::int64_t begin = firstCell < endCell ? this->introducedBefore(firstCell) : 0;
  for (std::int64_t& corner : piece.corners)
  {
    corner = piece.ids[static_cast<std::size_t>(corner)];
  }
  const GhostCells ghosts(
    this->File, this->LastCells, { firstCell, endCell, begin }, piece.ids, levels);
  this->addCells(ghosts, piece);
  std::vector<std::int64_t> vertices = ghosts.corners();
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::erase_if(vertices,
    [&piece](std::int64_t vertex) { return std::ranges::binary_search(piece.ids, vertex); });
  this->addVertices(vertices, piece);
  for (std::int64_t& corner : piece.corners)
  {
    corner = std::ranges::lower_bound(piece.ids, corner) - piece.ids.begin();
  }
}

void PieceReader::addCells(const GhostCells& ghosts, MeshPiece& piece)
{
  const std::vector<std::int64_t>& cells = ghosts.cells();
  const std::ptrdiff_t before = std::ranges::lower_bound(cells, piece.firstCell) - cells.begin();
  const std::size_t own = piece.corners.size() / static_cast<std::size_t>(this->Corners);
  piece.ghostCells.assign(own, 0);
  piece.ghostCells.insert(piece.ghostCells.begin(), static_cast<std::size_t>(before), 1);
  piece.ghostCells.resize(own + cells.size(), 1);
  // Of what has `size` entries a cell.
  const auto surround = [before](auto& values, const auto& added, std::ptrdiff_t size)
  {
    const auto behind = added.begin() + before * size;
    values.insert(values.end(), behind, added.end());
    values.insert(values.begin(), added.begin(), behind);
  };
  surround(piece.corners, ghosts.corners(), this->Corners);
  for (std::size_t c = 0; c < this->CellColumns.size(); ++c)
  {
    RowReader& reader = this->CellColumns[c];
    std::vector<std::byte> tuples(cells.size() * reader.tupleBytes());
    reader.gather(cells, tuples.data());
    surround(piece.cellColumns[c].bytes, tuples, static_cast<std::ptrdiff_t>(reader.tupleBytes()));
  }
}

void PieceReader::addVertices(std::span<const std::int64_t> vertices, MeshPiece& piece)
{
  this->Fetched.reset(this->VertexSpecs);
  this->Anywhere.gather(vertices, this->Fetched);
  VertexRows own;
  own.ids = std::move(piece.ids);
  own.positions = std::move(piece.positions);
  own.lastCells.resize(own.ids.size());
  own.columns = std::move(piece.vertexColumns);
  const std::vector<std::uint8_t> ghost = std::move(piece.ghost),
                                  finalized = std::move(piece.finalized);
  piece.ghost.clear();
  piece.finalized.clear();
  this->Rows.reset(this->VertexSpecs);
  for (std::int64_t a = 0, b = 0; a < own.size() || b < this->Fetched.size();)
  {
    const bool isOwn =
      b == this->Fetched.size() || (a < own.size() && own.ids[a] < this->Fetched.ids[b]);
    piece.ghost.push_back(isOwn ? ghost[static_cast<std::size_t>(a)] : 1);
    piece.finalized.push_back(isOwn ? finalized[static_cast<std::size_t>(a)] : 0);
    this->Rows.append(isOwn ? own : this->Fetched, isOwn ? a++ : b++);
  }
  std::swap(piece.ids, this->Rows.ids);
  std::swap(piece.positions, this->Rows.positions);
  std::swap(piece.vertexColumns, this->Rows.columns);
}

void PieceReader::readCells(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece)
{
  piece.corners.clear();
  for (std::int64_t cell = firstCell; cell < endCell;)
  {
    const std::int64_t block = this->File.Blocks.blockOf(VsmFormat::Cells, cell);
    const std::int64_t first = this->File.Blocks.firstRow(VsmFormat::Cells, block);
    const std::int64_t end =
      std::min(endCell, first + this->File.Blocks.blockRows(VsmFormat::Cells, block));
    const auto corners = this->cornersOfBlock(block).begin();
    piece.corners.insert(piece.corners.end(), corners + (cell - first) * this->Corners,
      corners + (end - first) * this->Corners);
    cell = end;
  }
  piece.cellColumns.resize(this->CellSpecs.size());
  for (std::size_t c = 0; c < this->CellSpecs.size(); c++)
  {
    Column& column = piece.cellColumns[c];
    column.spec = this->CellSpecs[c];
    column.resize(endCell - firstCell);
    this->CellColumns[c].read(firstCell, endCell - firstCell, column.bytes.data());
  }
}

const std::vector<std::int64_t>& PieceReader::cornersOfBlock(std::int64_t block)
{
  if (block != this->Block)
  {
    this->Block = -1;
    this->File.readCorners(block, this->BlockCorners);
    this->Block = block;
  }
  return this->BlockCorners;
}

std::int64_t PieceReader::introducedBefore(std::int64_t cell)
{
  if (cell == this->File.Info.cells)
  {
    return this->File.Info.vertices;
  }
  const std::int64_t block = this->File.Blocks.blockOf(VsmFormat::Cells, cell);
  const std::int64_t before = cell - this->File.Blocks.firstRow(VsmFormat::Cells, block);
  std::int64_t introduced = this->File.firstVertex(block);
  if (before > 0)
  {
    // In a compact stream, the vertices introduced so far are those up to the largest one used.
    const auto corners = this->cornersOfBlock(block).begin();
    introduced =
      std::max(introduced, *std::max_element(corners, corners + before * this->Corners) + 1);
  }
  return introduced;
}

void PieceReader::collect(
  std::span<const std::int64_t> ghosts, std::int64_t begin, std::int64_t end)
{
  this->Missing.clear();
  std::set_difference(ghosts.begin(), ghosts.end(), this->Alive.ids.begin(), this->Alive.ids.end(),
    std::back_inserter(this->Missing));
  this->Fetched.reset(this->VertexSpecs);
  this->Anywhere.gather(this->Missing, this->Fetched);
  this->Rows.reset(this->VertexSpecs);
  std::int64_t fetched = 0;
  auto alive = this->Alive.ids.begin();
  for (const std::int64_t ghost : ghosts)
  {
    if (fetched < this->Fetched.size() && this->Fetched.ids[fetched] == ghost)
    {
      this->Rows.append(this->Fetched, fetched++);
    }
    else
    {
      alive = std::lower_bound(alive, this->Alive.ids.end(), ghost);
      this->Rows.append(this->Alive, alive - this->Alive.ids.begin());
    }
  }
  this->InOrder.read(begin, end - begin, this->Rows);
}

void PieceReader::remember(std::int64_t end, std::int64_t endCell)
{
  this->NextAlive.reset(this->VertexSpecs);
  std::int64_t a = 0;
  std::int64_t b = 0;
  while (a < this->Alive.size() || b < this->Rows.size())
  {
    const bool old =
      b == this->Rows.size() || (a < this->Alive.size() && this->Alive.ids[a] < this->Rows.ids[b]);
    const VertexRows& from = old ? this->Alive : this->Rows;
    const std::int64_t row = old ? a : b;
    if (from.lastCells[row] >= endCell && from.ids[row] < end)
    {
      this->NextAlive.append(from, row);
    }
    a += old || (a < this->Alive.size() && this->Alive.ids[a] == from.ids[row]) ? 1 : 0;
    b += old ? 0 : 1;
  }
  std::swap(this->Alive, this->NextAlive);
}

} // namespace smg
