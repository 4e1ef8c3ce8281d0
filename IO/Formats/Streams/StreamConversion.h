// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Streams/StreamFile.h"
#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace smg
{

class MovedVertices;

struct StreamToVsmOptions
{
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Bytes of memory for waiting vertices and cells; at least 8 MiB are used. */
  std::int64_t memory = std::int64_t(64) << 20;
  ProgressFunction progress;
};

struct StreamToVsmResult
{
  StreamInfo info;
  std::int64_t isolatedVertices = 0; ///< vertices of no cell, in addition to the stream
};

/** The cells and the columns of the stream of a file. */
StreamInfo streamInfoOf(const StreamFileHeader& header);

/**
 * Converts a streaming mesh file (SMA, SMB, SVA, SVB; see StreamFile.h) to a .vsm file with the
 * same order of cells, in the codec of temporary files. Vertices are renumbered by first use; the
 * columns OriginalId and OriginalCellId store their indices in the file. The memory depends neither
 * on the mesh nor on the quality of its order: waiting data that exceed it are written to a scratch
 * file. Throws Error; Cancelled if the progress callback requests it. Then no output and no scratch
 * file is left.
 */
StreamToVsmResult streamToVsm(const std::filesystem::path& in, const std::filesystem::path& out,
  const StreamToVsmOptions& options = {});

/**
 * Writes a .vsm file as SMA, SMB, SVA or SVB, by the suffix of `out`: pre-order, compact, vertices
 * final by their last cell, little-endian, counts and bounds in the header, no comments. Positions
 * become single precision; columns are omitted, except for the scalar of SVA and SVB (see
 * StreamFile.h). Returns notes for the user on columns that were omitted and positions that were
 * rounded. Last uses of vertices that have no room in memory are written to a scratch file in
 * `scratch` (empty: the system's temporary folder). Throws Error if there are more than 2^31 - 1
 * vertices or cells, or if a coordinate is too large for single precision.
 */
std::vector<std::string> vsmToStream(const std::filesystem::path& in,
  const std::filesystem::path& out, const std::filesystem::path& scratch = {},
  const ProgressFunction& progress = {});

/**
 * Writes the streaming mesh file `in` again as `out`, another or the same of the four formats, with
 * its vertices moved; see rewriteMesh(). Comments are kept in text. Throws Error; Cancelled.
 */
void rewriteStream(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const ProgressFunction& progress, const std::function<void()>& beforeEnd);

} // namespace smg
