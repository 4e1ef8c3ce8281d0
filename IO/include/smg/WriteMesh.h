// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace smg
{

struct IsolatedVertices;

/** Adds columns to vertices of no cell, of which the first one has this number among them, in place
 * of those of the same names; empty: none. */
using CompleteIsolated = std::function<void(std::int64_t first, IsolatedVertices& vertices)>;

/** How to write a mesh. */
struct WriteMeshOptions
{
  /** Compression of a .vsm file. */
  Codec codec = Codec::Zstd;
  /** Write text where the format has a binary and a text form. Numbers read back exactly. With a
   * format of binary files it is an error. */
  bool text = false;
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch{};
  /** A .vsm file whose isolated vertices, with the columns that both have, are copied into a new
   * .vsm file; empty: none. */
  std::filesystem::path isolatedFrom{};
  /** Unless empty, the fingerprint that this file must have (StoredMesh::fileFingerprint()). */
  std::string isolatedFingerprint{};
  /** Adds to these vertices columns that the .vsm file does not have. */
  CompleteIsolated completeIsolated{};
  /** Changes these vertices when they have the columns that are written, in place. */
  CompleteIsolated changeIsolated{};
  /** Threads that compress the blocks of a .vsm file; 0: one per core. The file does not depend on
   * them. */
  int threads = 0;
  /** Progress callback; empty: none. */
  ProgressFunction progress{};
};

/**
 * Writes a mesh stream.
 * @param source the stream, read to its end; its StreamInfo must have the numbers of vertices and
 * cells
 * @param path the file, in the format of its suffix, one that is written according to
 * docs/formats.md, which says what columns it holds
 * @param options how to write
 * @return a sentence for each thing that the format cannot hold as the mesh has it
 * @throws Error if meshes or such cells are not written with this suffix, the stream is not valid,
 * or the file cannot be written
 * @throws Cancelled if the progress callback returns false. No file remains after an exception.
 */
SMG_EXPORT std::vector<std::string> writeMesh(
  MeshSource& source, const std::filesystem::path& path, const WriteMeshOptions& options = {});

/**
 * Writes the mesh of a .vsm file as writeMesh() does; a .vsm file keeps the isolated vertices.
 * @param vsm the .vsm file
 * @param path the file to write
 * @param progress progress callback; empty: none
 * @param scratch folder for scratch files; empty: the system's temporary folder
 * @param text see WriteMeshOptions::text
 * @return as writeMesh()
 * @throws Error as writeMesh(), or if `vsm` cannot be read
 * @throws Cancelled as writeMesh()
 */
SMG_EXPORT std::vector<std::string> writeFromVsm(const std::filesystem::path& vsm,
  const std::filesystem::path& path, const ProgressFunction& progress = {},
  const std::filesystem::path& scratch = {}, bool text = false);

/** How to write a mesh file again with other positions. */
struct RewriteOptions
{
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch{};
  /** Memory for positions that are being sorted, bytes; less than 16 MiB counts as 16 MiB. */
  std::int64_t memory = std::int64_t(64) << 20;
  bool text = false; ///< see WriteMeshOptions; a streaming format is text or binary by its suffix
  /** Progress callback; empty: none. */
  ProgressFunction progress{};
  /** Called before `out` gets its name: what it throws leaves that as it was. Empty: none. */
  std::function<void()> beforeEnd{};
};

/**
 * Whether rewriteMesh() can write `out` from `in`: both are streaming formats (SMA, SMB, SVA, SVB)
 * of the same kind of cells, or both are PLY (`in` not compressed). `in` goes by its content, `out`
 * by its suffix.
 * @throws Error if `in` cannot be read
 */
SMG_EXPORT bool canRewrite(const std::filesystem::path& in, const std::filesystem::path& out);

/**
 * Writes a mesh file again with its vertices moved: the same vertices and cells in the same order,
 * including vertices of no cell, and everything else that the file has of them.
 *
 * Streaming formats: pre-order stays pre-order, post-order stays post-order, and vertices become
 * final where they do in `in`; counts and bounds are in the header if `in` has them. Positions are
 * rounded to single precision.
 *
 * PLY: the same elements, properties and comments, in binary or text. If `moved` has the vertex
 * column Normals of 3 components, it replaces properties nx, ny, nz of the vertices; otherwise
 * these are left out, and so are always those of faces, since they would be stale.
 *
 * @param in the mesh file
 * @param out the file to write; see canRewrite()
 * @param moved the stream made from `in` (for instance by openMesh()) with the new positions and
 * the column OriginalId, in any order: it is sorted out of core. Vertices that it lacks stay where
 * they are.
 * @param options how to write
 * @throws Error if canRewrite() is false, `in` is not valid, an OriginalId is not a vertex of `in`,
 * or `out` cannot be written
 * @throws Cancelled if the progress callback returns false. No output remains after an exception.
 */
SMG_EXPORT void rewriteMesh(const std::filesystem::path& in, const std::filesystem::path& out,
  MeshSource& moved, const RewriteOptions& options = {});

} // namespace smg
