// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/** How to write a mesh. */
struct WriteMeshOptions
{
  /** How a .vsm file is compressed. */
  Codec codec = Codec::Zstd;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** A .vsm file whose isolated vertices a new .vsm file keeps; empty: none. See writeVsm(). */
  std::filesystem::path isolatedFrom;
  ProgressFunction progress;
};

/**
 * Writes a mesh stream, which says its numbers of vertices and cells, in the format of the suffix:
 * .vsm, .ply, .vtp, .vtu or .vtkhdf with all its columns, or .sma, .smb, .sva or .svb.
 * @return a sentence for each thing that the format does not hold as the mesh has it
 * @throws Error as checkOutput() in MeshFile.h, if the stream is not valid, or the file cannot be
 * written; Cancelled. Nothing is left of the file then.
 */
SMG_EXPORT std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options = {});

/** The same of a .vsm file. */
SMG_EXPORT std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress = {});

/** How to write a mesh file anew. */
struct RewriteOptions
{
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Bytes of memory for positions that wait for their turn. */
  std::int64_t memory = std::int64_t(64) << 20;
  ProgressFunction progress;
};

/**
 * Whether rewriteMesh() writes `out` from `in`: both names or contents are those of streaming
 * formats (SMA, SMB, SVA, SVB) of the same cells, or both of PLY. Throws Error if `in` cannot be
 * read.
 */
SMG_EXPORT bool canRewrite(const std::filesystem::path& in, const std::filesystem::path& out);

/**
 * Writes the mesh file `in` again as `out`, with its vertices moved: the same vertices and cells in
 * the same order, also vertices of no cell, and everything else that the file says of them.
 *
 * `moved` is the mesh stream that was made of `in` (by openMesh(), for instance) with the new
 * positions and the column OriginalId. Vertices that it lacks stay where they are. The order of the
 * stream may be any: positions are brought back into the order of `in` out of core.
 *
 * Streaming formats: pre-order stays pre-order, post-order post-order, and the vertices are final
 * where `in` says so; counts and bounds stand in the header if `in` has them. Positions become
 * single precision.
 *
 * PLY: the same elements, properties and comments, in binary. If `moved` has the vertex column
 * Normals of 3 components, these are the new nx, ny, nz of vertices that have such properties;
 * otherwise these are left out, and always those of faces, since they would be stale.
 * @throws Error if `in` is not valid, a number of `moved` is none of a vertex of `in`, or `out`
 * cannot be written; Cancelled. Nothing is left of `out` then.
 */
SMG_EXPORT void rewriteMesh(const std::filesystem::path& in, const std::filesystem::path& out,
  MeshSource& moved, const RewriteOptions& options = {});

} // namespace smg
