// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
#include "IO/External/PagedArray.h"
#include "IO/Formats/Vsm/VsmBuffers.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** How to write a .vsm file. */
struct VsmWriterOptions
{
  Codec codec = Codec::Zstd;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch = {};
  IoStatistics* statistics = nullptr;
  /** Threads that compress blocks, see BlockFileWriter. */
  Workers* workers = nullptr;
};

/**
 * Writes a .vsm file: a mesh stream with its statistics, in blocks that are readable by themselves
 * (see VsmFormat.h). The blocks of the stream are appended in stream order and may have any size.
 *
 * The memory does not depend on the mesh: data of a vertex that are known only after its last cell
 * are stored in pages, which are written to a scratch file if there are too many. A stream whose
 * `MeshBlock::finalized` advances needs nearly no pages and no file; 0 throughout is permitted.
 */
class SMG_EXPORT VsmWriter
{
public:
  /** Uses cellType, doublePositions and the columns of `info`; the rest is computed. Throws Error
   * if the file cannot be created or the name of a column is empty, reserved or used twice. */
  VsmWriter(const std::filesystem::path& path, const StreamInfo& info,
    const VsmWriterOptions& options = {});
  /** Without finish(), no file is left. */
  ~VsmWriter();

  /**
   * Appends the stream's next block. Throws Error if the block does not continue the stream, the
   * stream is not compact, a cell uses a vertex that was declared final, a coordinate is not
   * finite (or, with single precision positions, not a single precision number), or a column has a
   * wrong length.
   */
  void append(const MeshBlock& block);

  /**
   * Appends vertices of no cell (see IsolatedVertices.h), any time before finish(). They are
   * not part of the stream, nor of its order, counts, bounds and statistics.
   * @param ids their indices in the original file
   * @param columns like the vertex columns of the stream; if none, their values are zero
   * Throws Error if an id is negative, a coordinate cannot be stored (see append()), or a
   * length is wrong.
   */
  void isolated(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns = {});

  /**
   * Completes and renames the file. Returns counts, bounds, width and span. Throws Error if the
   * stream has no cells or a vertex that belongs to no cell.
   * @param origin the origin of the mesh for the header, in UTF-8; may be empty
   */
  StreamInfo finish(const std::string& origin = {});

  /** After finish(): the mean over the cells of the number of vertices alive. */
  double meanWidth() const { return this->MeanWidth; }

private:
  [[noreturn]] void fail(const std::string& what) const;
  void checkBlock(const MeshBlock& block) const;
  void addVertices(const MeshBlock& block);
  void addPositions(const MeshBlock& block, std::int64_t first, std::int64_t count);
  void addCells(const MeshBlock& block);
  void addCell(const std::int64_t* corners);
  void settle(std::int64_t end);

  void flushVertices();
  void flushLast();
  void flushCells();
  void writeBlockTable();
  void writeGroups();

  std::string Name;
  StreamInfo Info; ///< what has been appended so far
  int Corners;
  VsmBlockRows Rows;
  std::int64_t Introduced = 0; ///< vertices used so far
  std::int64_t Settled = 0;    ///< vertices whose last cell is known
  double MeanWidth = 0;

  PositionBuffer Positions; ///< of the current block
  RowBuffer VertexRows;
  std::vector<std::uint64_t> Distances; ///< corners of the current block
  RowBuffer CellRows;
  std::vector<std::uint64_t> LastRows;
  std::int64_t PreviousLast = 0;
  std::vector<std::byte> Packed;

  std::vector<std::int64_t> FirstVertex; ///< of each block of cells
  std::vector<std::int64_t> Finalized;   ///< after each block of cells, as far as known

  PagedArray<std::int64_t> LastCell; ///< so far
  StreamStatistics Statistics;
  IsolatedWriter Isolated;
  BlockFileWriter File;
};

} // namespace smg
