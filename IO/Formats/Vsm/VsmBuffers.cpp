// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/VsmBuffers.h"

#include "IO/External/Workspace.h"
#include "IO/Formats/Vsm/VsmFormat.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <utility>

namespace smg
{

namespace
{

/** The rows of a table, and what they take. */
struct TableRows
{
  std::int64_t count; ///< 0 or less: not known
  std::size_t columns;
  std::int64_t bytes; ///< of a row

  std::int64_t indexBytes(std::int64_t blockRows) const
  {
    return (std::max<std::int64_t>(this->count, 0) + blockRows - 1) / blockRows *
           indexBytesOfBlock(this->columns);
  }
  /** The fewest rows of a block with which the index of the table has at most `bytes`. */
  std::int64_t rowsForIndex(std::int64_t bytes) const
  {
    const std::int64_t blocks = std::max<std::int64_t>(bytes / indexBytesOfBlock(this->columns), 1);
    return (std::max<std::int64_t>(this->count, 0) + blocks - 1) / blocks;
  }
};

/** The rows of a block: `rows`, up to `most` for a small index, and any number for one that can be
 * read. */
std::int64_t withSmallIndex(std::int64_t rows, std::int64_t most, const TableRows& table)
{
  constexpr std::int64_t Small = std::int64_t(1) << 20, Large = MaxIndexBytes / 4;
  rows = std::max(rows, std::min(table.rowsForIndex(Small), most));
  const std::int64_t largest =
    std::clamp<std::int64_t>(MaxColumnBytes / table.bytes, rows, VsmFormat::BlockRows);
  return std::clamp(table.rowsForIndex(Large), rows, largest);
}

} // namespace

VsmBlockRows::VsmBlockRows(const StreamInfo& info, const std::string& file)
{
  const std::int64_t attributes = rowBytes(info.vertexColumns);
  const TableRows ofVertices{ info.vertices, 1 + info.vertexColumns.size(),
    attributes + positionBytes(info) };
  const std::int64_t few = VsmFormat::blockRows(attributes);
  const std::int64_t vertexRows = std::min(2 * few, VsmFormat::BlockRows);
  this->vertices = withSmallIndex(few, vertexRows, ofVertices);

  // A block of cells is in use as it is in the file and as it is delivered, with the vertices that
  // it introduces, at most its corners. The rest of the memory is for an index.
  constexpr std::int64_t Budget = (Workspace::MinMemory - (1 << 20)) / VsmFormat::BlocksInUse;
  constexpr std::int64_t CornerBytes = 5; // packed, of a distance in 2^40 vertices
  const std::int64_t corners = cornersOf(info.cellType);
  const std::int64_t stored = rowBytes(info.cellColumns, corners * CornerBytes);
  const std::int64_t left = Budget - std::min(Budget, vertexRows * ofVertices.bytes);
  const std::int64_t cellRows =
    std::clamp<std::int64_t>(left / (2 * stored + corners * attributes), 1, VsmFormat::BlockRows);
  const TableRows ofCells{ info.cells, 1 + info.cellColumns.size(), stored };
  const std::int64_t fewCells = VsmFormat::blockRows(rowBytes(info.cellColumns, attributes));
  this->cells = withSmallIndex(std::min(fewCells, cellRows), cellRows, ofCells);

  const std::int64_t index =
    ofVertices.indexBytes(this->vertices) + ofCells.indexBytes(this->cells);
  if (index > MaxIndexBytes)
  {
    throw Error(file + ": the index of the blocks of so many columns would have " +
                mebibytes(index) + ", but at most " + mebibytes(MaxIndexBytes) +
                " are read: leave columns out.");
  }
}

IsolatedWriter::IsolatedWriter(std::string name, const StreamInfo& info, std::int64_t blockRows)
  : Name(std::move(name))
  , Specs(info.vertexColumns)
  , BlockRows(blockRows)
  , Positions(info.doublePositions)
  , Rows(info.vertexColumns)
{
}

TableSpec IsolatedWriter::table(const StreamInfo& info)
{
  const ScalarType real = positionType(info.doublePositions);
  TableSpec table{ "isolated", { { "Id", ScalarType::Int64, 1 }, { "Position", real, 3 } } };
  table.columns.insert(table.columns.end(), info.vertexColumns.begin(), info.vertexColumns.end());
  return table;
}

void IsolatedWriter::fail(const std::string& what) const
{
  throw Error(this->Name + ": " + what);
}

void IsolatedWriter::check(std::span<const std::int64_t> ids, std::span<const double> positions,
  const std::vector<Column>& columns) const
{
  if (positions.size() != 3 * ids.size())
  {
    this->fail("there are not three coordinates for each isolated vertex.");
  }
  for (std::size_t c = 0; c < this->Specs.size() && !columns.empty(); ++c)
  {
    if (c >= columns.size() || columns[c].bytes.size() != ids.size() * this->Specs[c].tupleBytes())
    {
      this->fail("there are not " + std::to_string(ids.size()) + " values of column '" +
                 this->Specs[c].name + "' for the isolated vertices.");
    }
  }
}

void IsolatedWriter::append(BlockFileWriter& file, std::span<const std::int64_t> ids,
  std::span<const double> positions, const std::vector<Column>& columns)
{
  this->check(ids, positions, columns);
  std::vector<Column> zeros; // one of each column
  if (columns.empty())
  {
    for (const ColumnSpec& spec : this->Specs)
    {
      zeros.push_back({ spec, {} });
      zeros.back().resize(1);
    }
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] < 0)
    {
      this->fail("the isolated vertex " + std::to_string(ids[i]) + " has a negative number.");
    }
    this->Ids.push_back(ids[i]);
    for (const double x : positions.subspan(3 * i, 3))
    {
      if (!this->Positions.append(x))
      {
        this->fail("the coordinate " + std::to_string(x) + " of the isolated vertex " +
                   std::to_string(ids[i]) +
                   " is not finite, or not a single precision number as the others are.");
      }
    }
    columns.empty() ? this->Rows.append(zeros, 0, 1)
                    : this->Rows.append(columns, static_cast<std::int64_t>(i), 1);
    if (static_cast<std::int64_t>(this->Ids.size()) == this->BlockRows)
    {
      this->finish(file);
    }
  }
}

void IsolatedWriter::finish(BlockFileWriter& file)
{
  if (this->Ids.empty())
  {
    return;
  }
  file.append(VsmFormat::Isolated, static_cast<std::int64_t>(this->Ids.size()),
    this->Rows.block({ std::as_bytes(std::span(this->Ids)), this->Positions.bytes() }));
  this->Ids.clear();
  this->Positions.clear();
  this->Rows.clear();
}

StreamStatistics::StreamStatistics(const std::filesystem::path& scratch)
  : Changes(scratch, std::int64_t(1) << 20)
{
}

void StreamStatistics::count(std::int64_t cells, std::int64_t vertices)
{
  for (; this->Cells < cells; this->Cells++)
  {
    const std::uint8_t change = this->Changes.get(this->Cells);
    // A vertex ends after it begins: only vertices up to this cell can end at it.
    if (this->Vertices + change % FinalUnit > vertices)
    {
      break;
    }
    this->Vertices += change % FinalUnit;
    this->Alive += change % FinalUnit;
    this->Width = std::max(this->Width, this->Alive);
    this->Sum += static_cast<double>(this->Alive);
    this->Alive -= change / FinalUnit;
  }
  this->Changes.discardBelow(this->Cells);
}

} // namespace smg
