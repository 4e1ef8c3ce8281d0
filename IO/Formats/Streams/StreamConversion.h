// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Storage/BlockFile.h"
#include "Solver/Stream/OriginalNumbers.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

struct StreamToVsmOptions
{
  Codec codec = Codec::Zstd;
  /** Folder for scratch files; empty: the folder of the output. */
  std::filesystem::path scratch;
  /** Bytes of memory for the vertices and cells that wait; at least 8 MiB are used. */
  std::int64_t memory = std::int64_t(64) << 20;
  ProgressFunction progress;
};

struct StreamToVsmResult
{
  StreamInfo info;
  std::int64_t isolatedVertices = 0; ///< vertices of no cell, beside the stream
};

/**
 * Makes a .vsm file of a streaming mesh file (SMA, SMB, SVA, SVB; see StreamFile.h), keeping the
 * order of its cells. Vertices are renumbered by first use; the columns OriginalId and
 * OriginalCellId keep their places in the file. The memory needed does not depend on the mesh nor
 * on the quality of its order: what waits for longer than the memory lasts goes to a scratch file.
 * Throws Error; Cancelled if the progress callback says so. Then no output and no scratch is left.
 */
StreamToVsmResult streamToVsm(const std::filesystem::path& in, const std::filesystem::path& out,
  const StreamToVsmOptions& options = {});

/**
 * Writes a .vsm file as SMA, SMB, SVA or SVB, by the suffix of `out`: pre-order, compact, vertices
 * final by their last cell, little-endian, counts and bounds in the header, no comments. Positions
 * become single precision; columns are left out, but for the scalar of SVA and SVB (see
 * StreamFile.h). Answers the number of vertices whose position was rounded. Throws Error if there
 * are more than 2^31 - 1 of anything, or a coordinate is too large for single precision.
 */
std::int64_t vsmToStream(const std::filesystem::path& in, const std::filesystem::path& out,
  const ProgressFunction& progress = {});

/** What a user should know of it: a sentence if there were any. */
std::vector<std::string> notesOnRounded(std::int64_t vertices);

} // namespace smg
