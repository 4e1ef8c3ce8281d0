// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace smg
{

struct IoStatistics;

/** A range of consecutive cells of a mesh stream with all vertices that these cells use. */
struct MeshPiece
{
  std::int64_t firstCell = 0;          ///< stream index of the first cell of the piece
  std::vector<std::int64_t> ids;       ///< stream indices of the vertices, ascending
  std::vector<double> positions;       ///< x, y, z of each vertex
  std::vector<float> normals;          ///< x, y, z per vertex of previews, else empty
  std::vector<std::uint8_t> ghost;     ///< 1: introduced by a cell before the piece
  std::vector<std::uint8_t> finalized; ///< 1: no cell after the piece uses the vertex
  std::vector<std::int64_t> corners;   ///< indices in `ids`, cornersOf(cellType) per cell
  std::vector<Column> vertexColumns;   ///< a tuple per vertex
  std::vector<Column> cellColumns;     ///< a tuple per cell

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->ids.size()); }
};

/** Vertices of no cell. A mesh stream has none; its container stores them separately, to restore
 * the original file. */
struct IsolatedVertices
{
  std::vector<std::int64_t> ids; ///< indices in the original file
  std::vector<double> positions; ///< x, y, z of each vertex
  std::vector<Column> columns;   ///< the columns of the stream, a tuple per vertex
};

/**
 * Reads a .vsm file as a stream from first block to last, or any piece independently. Every failure
 * is an Error that names the file. One thread at a time; sources may be used by other threads.
 */
class SMG_EXPORT VsmReader
{
public:
  explicit VsmReader(std::filesystem::path path, IoStatistics* statistics = nullptr);
  ~VsmReader();
  VsmReader(const VsmReader&) = delete;
  VsmReader& operator=(const VsmReader&) = delete;

  const std::filesystem::path& path() const;
  /** Counts, bounds, width, span, precision and the names of all columns. */
  const StreamInfo& info() const;
  /** The mean over the cells of the number of active vertices. */
  double meanWidth() const;
  /** The statistics in the header of the file. */
  const std::string& header() const;
  Codec codec() const;
  std::int64_t vertexBlocks() const;
  std::int64_t cellBlocks() const;
  /** The bytes of the file, and the uncompressed bytes of its columns. */
  std::int64_t storedBytes() const;
  std::int64_t plainBytes() const;

  /** The mesh stream from its first block, with prefetch; one block of the stream per cell block.
   * The source opens the file separately and may outlive the reader. */
  std::unique_ptr<MeshSource> source() const;
  /** The same with only the named columns, in this order, and CellFlags if the file has it, since
   * flagged cells must have no weight. Throws Error if a column does not exist. */
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const;

  /** Selects the columns of readPiece() and their order, in addition to CellFlags as above;
   * initially all. Throws Error if one does not exist. */
  void selectColumns(
    const std::vector<std::string>& vertexColumns, const std::vector<std::string>& cellColumns);

  /**
   * Fills `piece` with the cells [firstCell, endCell), which may be empty, and their vertices,
   * reusing the memory of its vectors. A piece that follows the previous one reads only the piece,
   * since active vertices are cached. Any other piece reads the blocks with its rows.
   */
  void readPiece(std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece);

  /** Reads column `name` of the vertices [first, first + count) into `column`. */
  void readVertexColumn(
    const std::string& name, std::int64_t first, std::int64_t count, Column& column);
  /** The last cell that uses each of the vertices from `first` on. */
  void readLastCells(std::int64_t first, std::span<std::int64_t> cells);

  /** The number of vertices of no cell, which are not part of the stream. */
  std::int64_t isolatedVertices() const;
  /** Reads `count` of them from index `first` on, with all columns, in the order of the file. */
  void readIsolated(std::int64_t first, std::int64_t count, IsolatedVertices& vertices);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
