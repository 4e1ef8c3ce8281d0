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

/** Consecutive cells of a mesh stream, with all vertices that they use. */
struct MeshPiece
{
  std::int64_t firstCell = 0;          ///< stream index of the first cell
  std::vector<std::int64_t> ids;       ///< stream indices of the vertices, ascending
  std::vector<double> positions;       ///< x, y, z of each vertex
  std::vector<float> normals;          ///< x, y, z of each vertex; only of previews, else empty
  std::vector<std::uint8_t> ghost;     ///< of each vertex, 1: introduced by a cell of another piece
  std::vector<std::uint8_t> finalized; ///< of each vertex, 1: no cell of a later piece uses it
  std::vector<std::int64_t> corners;   ///< indices into `ids`, cornersOf(cellType) a cell
  std::vector<Column> vertexColumns;   ///< a tuple a vertex
  std::vector<Column> cellColumns;     ///< a tuple a cell
  /** Of each cell, 1: it is of another piece, a neighbour of this one; empty: none is. */
  std::vector<std::uint8_t> ghostCells;

  /** Number of vertices. */
  std::int64_t vertices() const { return static_cast<std::int64_t>(this->ids.size()); }
};

/**
 * Vertices of no cell. They are not part of the stream; a .vsm file keeps them beside it, for a
 * mesh that is written in the order of its original file.
 */
struct IsolatedVertices
{
  std::vector<std::int64_t> ids; ///< places in the original file
  std::vector<double> positions; ///< x, y, z of each vertex
  std::vector<Column> columns;   ///< the vertex columns of the stream, a tuple a vertex
};

/**
 * Reads a .vsm file: as a stream from the first block to the last, or any piece by itself. Every
 * function throws Error naming the file if that cannot be read or is damaged. Not for two threads
 * at once; the sources that it makes may be used on other threads.
 */
class SMG_EXPORT VsmReader : public StoredMesh
{
public:
  /**
   * Opens a file.
   * @param path the file
   * @param statistics counts what is read, and must outlive the reader and its sources; null: no
   * counts
   * @param fingerprint unless empty, that which the file must have, for a file that has been open
   * before
   * @throws Error if it is not a .vsm file, its header is damaged, or it is another mesh
   */
  explicit VsmReader(std::filesystem::path path, IoStatistics* statistics = nullptr,
    const std::string& fingerprint = {});
  ~VsmReader() override;
  VsmReader(const VsmReader&) = delete;
  VsmReader& operator=(const VsmReader&) = delete;

  /** The file, as given to the constructor. */
  const std::filesystem::path& path() const;
  /** Counts, bounds, width, span, precision and all columns. */
  const StreamInfo& info() const override;
  /** Mean over the cells of the number of vertices alive (see StreamInfo::width). */
  double meanWidth() const;
  /** The header of the file: a JSON object with the kind of cells, precision, counts, bounds,
   * width, span, mean width and perhaps `origin`. */
  const std::string& header() const;
  /** How the columns are compressed. */
  Codec codec() const;
  std::string fingerprint() const override;
  std::filesystem::path file() const override { return this->path(); }
  /** Throws Error unless the blocks of the file, which are read as a whole, take at most a part of
   * this many bytes of memory with all their columns. */
  void requireBlocksWithin(std::int64_t memory) const;

  /** Number of blocks of vertices, of 8192 each or fewer, the last one fewer. */
  std::int64_t vertexBlocks() const;
  /** Number of blocks of cells, of 8192 each or fewer, the last one fewer. */
  std::int64_t cellBlocks() const;
  /** Size of the file, bytes. */
  std::int64_t storedBytes() const;
  /** Size of all columns, uncompressed, bytes. */
  std::int64_t plainBytes() const;

  /**
   * The mesh stream with all columns, from its first block, read ahead. Each block of the stream is
   * a block of cells with the vertices that it introduces. The source opens the file for itself,
   * may outlive the reader, and throws Error if the file has been replaced or changed meanwhile.
   */
  std::unique_ptr<MeshSource> source() const;
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override;

  /**
   * Selects the columns that readPiece() delivers, as for source(); at first these are all columns.
   * @param vertexColumns names of vertex columns, in the order in which pieces have them
   * @param cellColumns names of cell columns, likewise; CellFlags is appended as above
   * @throws Error if a column does not exist
   */
  void selectColumns(
    const std::vector<std::string>& vertexColumns, const std::vector<std::string>& cellColumns);

  /**
   * Reads the cells [firstCell, endCell), which may be none, and their vertices. A piece that
   * follows the one read before costs no more than its own rows, since vertices that are still
   * alive are remembered; any other piece costs the blocks that hold its rows.
   * @param firstCell stream index of the first cell
   * @param endCell stream index after the last cell, at most the number of cells
   * @param piece replaced by the piece; the memory of its vectors is reused
   * @param ghostLevels layers of cells around the piece to add, in the order of the stream: those
   * that share a vertex with a cell of it, those that share one with these, ... Each layer costs
   * reading the corners of the blocks of cells in which vertices at the border of the layer before
   * are alive.
   */
  void readPiece(
    std::int64_t firstCell, std::int64_t endCell, MeshPiece& piece, int ghostLevels = 0);

  /**
   * Reads a column of the vertices [first, first + count).
   * @param name the column
   * @param first stream index of the first vertex
   * @param count number of vertices
   * @param column replaced by the column, `count` tuples
   * @throws Error if the column or one of the vertices does not exist
   */
  void readVertexColumn(
    const std::string& name, std::int64_t first, std::int64_t count, Column& column);
  /**
   * Reads the last cell that uses each of some consecutive vertices.
   * @param first stream index of the first vertex
   * @param cells set to stream indices of cells, one a vertex; its size is the number of vertices
   * @throws Error if one of the vertices does not exist
   */
  void readLastCells(std::int64_t first, std::span<std::int64_t> cells);

  /** Number of vertices of no cell. */
  std::int64_t isolatedVertices() const;
  /**
   * Reads vertices of no cell, with all columns.
   * @param first number of the first one, from 0, in the order of the .vsm file
   * @param count how many to read
   * @param vertices replaced by these vertices
   * @throws Error if there are not so many
   */
  void readIsolated(std::int64_t first, std::int64_t count, IsolatedVertices& vertices);

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
