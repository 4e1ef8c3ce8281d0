// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VertexReader.h"

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

} // namespace smg
