// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BlockFile.h"
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
  VsmWriter(
    std::filesystem::path path, const StreamInfo& info, const VsmWriterOptions& options = {});
  /** Without finish(), no file is left. */
  ~VsmWriter();
  VsmWriter(const VsmWriter&) = delete;
  VsmWriter& operator=(const VsmWriter&) = delete;

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
  double meanWidth() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
