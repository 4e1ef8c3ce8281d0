// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Export.h"
#include "smg/Groups.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

/** The kind of the cells of a mesh stream; the value is the number of corners of a cell. */
enum class CellType : std::uint8_t
{
  Triangle = 3,   ///< of a surface in space
  Tetrahedron = 4 ///< of a volume
};

/** Number of corners of a cell: 3 or 4. */
constexpr int cornersOf(CellType type)
{
  return static_cast<int>(type);
}

/** Name of the optional cell column (uint8) that marks cells without weight: see CellFlag. */
inline constexpr const char* CellFlagsName = "CellFlags";

/** Bits of the `CellFlags` column. A cell with any bit set is part of the mesh without weight. */
enum CellFlag : std::uint8_t
{
  DegenerateCell = 1, ///< repeated corners, or zero area or volume
  DuplicateCell = 2   ///< an earlier cell has the same corners
};

/** Vertex column (int64) that a conversion adds: indices in the original file, from 0. */
inline constexpr const char* OriginalIdName = "OriginalId";
/** The specification of the column OriginalId. */
inline const ColumnSpec OriginalIdSpec{ OriginalIdName, ScalarType::Int64, 1 };
/** Cell column (int64) that a conversion adds: indices in the original file, from 0. */
inline constexpr const char* OriginalCellIdName = "OriginalCellId";
/** The specification of the column OriginalCellId. */
inline const ColumnSpec OriginalCellIdSpec{ OriginalCellIdName, ScalarType::Int64, 1 };

/**
 * Information on a mesh stream that is known before it is read.
 *
 * A mesh stream is *compact*: stream indices number the vertices 0, 1, ... in the order in which
 * the cells first use them. So cell c uses only vertices introduced by cells 0 to c, and every
 * vertex belongs to at least one cell.
 */
struct StreamInfo
{
  CellType cellType = CellType::Triangle; ///< the kind of all cells
  std::int64_t vertices = 0;              ///< number of vertices; 0 or less: not known
  std::int64_t cells = 0;                 ///< number of cells; 0 or less: not known
  std::array<double, 6> bounds{};         ///< xmin, xmax, ymin, ymax, zmin, zmax; all 0: not known
  /** Largest number of vertices alive at a cell: introduced, and used by it or a later one. -1: not
   * known. */
  std::int64_t width = -1;
  /** Largest difference of the stream indices of two vertices of a cell; -1: not known. */
  std::int64_t span = -1;
  /** Whether positions have double precision; false: all of them are single precision numbers. */
  bool doublePositions = true;
  std::vector<ColumnSpec> vertexColumns; ///< columns of the vertices, in the order that blocks have
  std::vector<ColumnSpec> cellColumns;   ///< columns of the cells, in the order that blocks have
  MeshGroups groups; ///< named parts of the mesh; the columns VertexGroups ... say where they are
};

/**
 * A part of a mesh stream: consecutive vertices, and consecutive cells that use these or earlier
 * ones. Blocks may have any size; a block may lack vertices or cells, but not both.
 */
struct MeshBlock
{
  std::int64_t firstVertex = 0;      ///< stream index of the block's first vertex
  std::int64_t firstCell = 0;        ///< stream index of the block's first cell
  std::vector<double> positions;     ///< x, y, z of each vertex of the block
  std::vector<std::int64_t> corners; ///< stream indices, cornersOf(cellType) a cell
  std::vector<Column> vertexColumns; ///< as StreamInfo::vertexColumns, a tuple a vertex
  std::vector<Column> cellColumns;   ///< as StreamInfo::cellColumns, a tuple a cell
  /** No later block's cell uses a vertex below this index. Does not decrease from block to block.
   */
  std::int64_t finalized = 0;

  /** Number of vertices of the block. */
  std::int64_t vertices() const { return static_cast<std::int64_t>(this->positions.size() / 3); }

  /** The cell column of CellFlag bits; null if the block has none. */
  const Column* flags() const
  {
    const auto found = std::ranges::find(
      this->cellColumns, CellFlagsName, [](const Column& column) { return column.spec.name; });
    return found == this->cellColumns.end() ? nullptr : &*found;
  }
};

/** A mesh stream, delivered once, from the first block to the last. */
class SMG_EXPORT MeshSource
{
public:
  virtual ~MeshSource() = default;

  /** What is known of the stream, from construction on. */
  virtual const StreamInfo& info() const = 0;

  /**
   * Delivers the next block. solve() and deform() call this on the caller's thread, unless
   * readsOnAnyThread().
   * @param block replaced by the block; the memory of its vectors is reused
   * @return false at the end of the stream, where `block` is not to be used
   * @throws Error if the mesh cannot be read or is not valid
   */
  virtual bool next(MeshBlock& block) = 0;

  /** Whether next() may be called on any thread, on one at a time: then a solve reads a block ahead
   * on another thread than the caller's. */
  virtual bool readsOnAnyThread() const { return false; }
};

/** A mesh that can be read as a stream any number of times, on disk or in memory. */
class SMG_EXPORT StoredMesh
{
public:
  virtual ~StoredMesh() = default;

  /** What is known of the stream, with all columns. */
  virtual const StreamInfo& info() const = 0;

  /**
   * The mesh stream with some of its columns, from its first block.
   * @param vertexColumns names of vertex columns, in the order in which blocks have them
   * @param cellColumns names of cell columns, likewise. CellFlags is appended if the mesh has it:
   * without it, flagged cells would have weight.
   * @throws Error if a column does not exist
   */
  virtual std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const = 0;

  /** A text that is another one if anything of the mesh is; for CheckpointOptions::mesh. Empty:
   * none is known. */
  virtual std::string fingerprint() const { return {}; }
  /** The .vsm file that has the mesh, for what is beside its stream; empty: there is none. */
  virtual std::filesystem::path file() const { return {}; }
  /** A text that names the content of file(), with which whoever opens that again compares it:
   * VsmReader::fingerprint() of the file. It is fingerprint() unless the mesh has more than its
   * file. Empty: none is known. */
  virtual std::string fileFingerprint() const { return this->fingerprint(); }
};

} // namespace smg
