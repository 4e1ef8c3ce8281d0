// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/External/PagedArray.h"
#include "smg/Column.h"
#include "smg/MeshSource.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * The rows of the blocks of a .vsm file, except for the last ones. They are as many as the least
 * memory of an operation can read (see VsmReader::requireBlocksWithin()), and only more where the
 * index of all blocks would be too large otherwise.
 */
struct VsmBlockRows
{
  /** Throws Error, which begins with `file`, if the index would be too large in any case. */
  VsmBlockRows(const StreamInfo& info, const std::string& file);

  std::int64_t vertices, cells;
};

/** Collects rows of some columns until they fill a block. */
class RowBuffer
{
public:
  explicit RowBuffer(const std::vector<ColumnSpec>& columns)
    : Bytes(columns.size())
  {
    for (const ColumnSpec& column : columns)
    {
      this->TupleBytes.push_back(column.tupleBytes());
    }
  }

  /** Appends `count` rows of the columns `values`, from row `first` on. */
  void append(const std::vector<Column>& values, std::int64_t first, std::int64_t count)
  {
    for (std::size_t c = 0; c < this->Bytes.size(); c++)
    {
      const auto from = values[c].bytes.begin() + first * this->TupleBytes[c];
      this->Bytes[c].insert(this->Bytes[c].end(), from, from + count * this->TupleBytes[c]);
    }
  }

  /** The columns of a block: `first`, then the collected ones. Valid until rows are appended. */
  std::span<const std::span<const std::byte>> block(
    std::initializer_list<std::span<const std::byte>> first)
  {
    this->Spans.assign(first);
    this->Spans.insert(this->Spans.end(), this->Bytes.begin(), this->Bytes.end());
    return this->Spans;
  }

  void clear()
  {
    for (auto& bytes : this->Bytes)
    {
      bytes.clear();
    }
  }

private:
  std::vector<std::size_t> TupleBytes;
  std::vector<std::vector<std::byte>> Bytes;
  std::vector<std::span<const std::byte>> Spans;
};

/** Collects coordinates in the precision of a file. */
class PositionBuffer
{
public:
  explicit PositionBuffer(bool doublePositions)
    : IsDouble(doublePositions)
  {
  }

  /** Appends a coordinate; returns false if it is not finite or out of range in that precision. */
  bool append(double x)
  {
    const auto single = static_cast<float>(x);
    if (!std::isfinite(x) || (!this->IsDouble && static_cast<double>(single) != x))
    {
      return false;
    }
    if (this->IsDouble)
    {
      this->Doubles.push_back(x);
    }
    else
    {
      this->Floats.push_back(single);
    }
    return true;
  }

  std::size_t positions() const { return (this->Doubles.size() + this->Floats.size()) / 3; }
  std::span<const std::byte> bytes() const
  {
    return this->IsDouble ? std::as_bytes(std::span(this->Doubles))
                          : std::as_bytes(std::span(this->Floats));
  }
  void clear()
  {
    this->Doubles.clear();
    this->Floats.clear();
  }

private:
  bool IsDouble;
  std::vector<double> Doubles;
  std::vector<float> Floats;
};

/** Writes the table of the isolated vertices of a .vsm file. */
class IsolatedWriter
{
public:
  /** The vertices have the vertex columns of `info`, and blocks have so many rows. `name` is the
   * name of the file in errors. */
  IsolatedWriter(std::string name, const StreamInfo& info, std::int64_t blockRows);

  /** The specification of the table; see VsmFormat.h. */
  static TableSpec table(const StreamInfo& info);

  /** Appends vertices; see VsmWriter::isolated(). */
  void append(BlockFileWriter& file, std::span<const std::int64_t> ids,
    std::span<const double> positions, const std::vector<Column>& columns);

  /** Writes the remaining vertices. */
  void finish(BlockFileWriter& file);

private:
  [[noreturn]] void fail(const std::string& what) const;
  void check(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns) const;

  std::string Name;
  std::vector<ColumnSpec> Specs;
  std::int64_t BlockRows;
  std::vector<std::int64_t> Ids;
  PositionBuffer Positions;
  RowBuffer Rows; ///< without the positions
};

/** Tracks which vertices of a compact mesh stream are alive at each cell: from the cell that
 * introduces a vertex to the last one that uses it. The last uses may be given in any order. A cell
 * is counted, and forgotten, as soon as they are known of all vertices up to it. */
class StreamStatistics
{
public:
  /** Where vertices remain open for long, cells wait in a scratch file in `scratch`. */
  explicit StreamStatistics(const std::filesystem::path& scratch);

  /** Declares that `cell` is the first to use the next vertex. */
  void introduce(std::int64_t cell) { this->Changes.at(cell) += 1; }
  /** Declares that `cell` is the last to use a vertex. */
  void finalize(std::int64_t cell) { this->Changes.at(cell) += FinalUnit; }
  /** Counts what is known after the cells below `cells` and the last uses of the vertices below
   * `vertices`. */
  void count(std::int64_t cells, std::int64_t vertices);

  struct Result
  {
    std::int64_t width = 0; ///< most vertices alive at a cell
    double mean = 0;        ///< vertices alive at a cell, on average
  };
  /** Over the cells that were counted. */
  Result result() const
  {
    return { this->Width, this->Cells > 0 ? this->Sum / static_cast<double>(this->Cells) : 0 };
  }

private:
  /** A cell has at most four corners: half a byte each for the vertices that begin and end. */
  static constexpr std::uint8_t FinalUnit = 16;
  PagedArray<std::uint8_t> Changes;
  std::int64_t Cells = 0;    ///< counted
  std::int64_t Vertices = 0; ///< introduced by these
  std::int64_t Alive = 0;    ///< of these, after the last cell
  std::int64_t Width = 0;
  double Sum = 0;
};

} // namespace smg
