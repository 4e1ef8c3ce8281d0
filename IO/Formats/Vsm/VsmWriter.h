// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/BlockFile.h"
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

/**
 * Writes a .vsm file: a mesh stream with its statistics, in blocks that are readable by themselves
 * (see VsmFormat.h). The blocks of the stream are appended in stream order and may have any size.
 *
 * The memory needed does not depend on the mesh: what is known of a vertex only after its last cell
 * is kept in pages, which go to a scratch file beside `path` if they are too many. A stream whose
 * `MeshBlock::finalized` advances needs next to no pages; one that leaves it at 0 is legal.
 */
class SMG_EXPORT VsmWriter
{
public:
  /**
   * Of `info`, cellType, doublePositions and the columns count; the rest is computed.
   * Throws Error if the file cannot be made or a column's name is empty, reserved or used twice.
   */
  VsmWriter(std::filesystem::path path, const StreamInfo& info, Codec codec = Codec::Zstd,
    IoStatistics* statistics = nullptr);
  /** Without finish(), nothing is left of the file. */
  ~VsmWriter();
  VsmWriter(const VsmWriter&) = delete;
  VsmWriter& operator=(const VsmWriter&) = delete;

  /**
   * Appends the stream's next block. Throws Error if the block does not continue the stream, the
   * stream is not compact, a cell uses a vertex that was said to be final, a coordinate is not
   * finite (or, with single precision positions, not a single precision number), or a column has
   * not the length that it should have.
   */
  void append(const MeshBlock& block);

  /**
   * Appends vertices of no cell (see IsolatedVertices.h), any time before finish(). They are no
   * part of the stream: its order, counts, bounds and statistics do not know them.
   * @param ids their places in the original file
   * @param columns as the stream's vertex columns; none: their values are zero
   * Throws Error if an id is negative, a coordinate cannot be stored (see append()), or something
   * has not the length that it should have.
   */
  void isolated(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns = {});

  /**
   * Completes the file and gives it its name. Answers counts, bounds, width and span. Throws Error
   * if the stream has no cells or a vertex that belongs to no cell.
   * @param origin what the header says of where the mesh comes from, in UTF-8; empty: nothing
   */
  StreamInfo finish(const std::string& origin = {});

  /** After finish(): the mean over the cells of the number of vertices alive. */
  double meanWidth() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
