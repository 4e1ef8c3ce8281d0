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
  /** Bytes of memory for sorting positions. */
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
 * Writes the mesh file `in` as `out` with moved vertices: the same vertices and cells in the same
 * order, including vertices of no cell, and all other data of the file.
 *
 * `moved` is the mesh stream converted from `in` (for instance by openMesh()) with the new
 * positions and the column OriginalId, in any order; positions are sorted into the order of `in`
 * out of core. Vertices that it lacks keep their positions.
 *
 * Streaming formats: pre-order and post-order are kept, vertices are final at the same place as in
 * `in`, and counts and bounds are in the header if `in` has them. Positions become single
 * precision.
 *
 * PLY: the same elements, properties and comments, in binary. If `moved` has a vertex column
 * Normals of 3 components, it replaces the properties nx, ny, nz of vertices; otherwise these are
 * omitted. Those of faces are always omitted, since they would be outdated.
 * @throws Error if `in` is invalid, an index of `moved` is not a vertex of `in`, or `out` cannot be
 * written; Cancelled. No part of `out` is left then.
 */
SMG_EXPORT void rewriteMesh(const std::filesystem::path& in, const std::filesystem::path& out,
  MeshSource& moved, const RewriteOptions& options = {});

} // namespace smg
