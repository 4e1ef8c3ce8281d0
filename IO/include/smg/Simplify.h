// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Region.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/** How far to simplify a surface: as far as one of the two says that is given, at least. */
struct SimplifyTarget
{
  static constexpr std::int64_t MinVertices = 4;                     ///< of a tetrahedron
  static constexpr std::int64_t MaxVertices = std::int64_t(1) << 40; ///< more than any mesh has
  /** The most vertices of the result, MinVertices to MaxVertices; 0: as many as `error` needs. */
  std::int64_t vertices = 0;
  /** The largest error, in the unit of the mesh, more than 0: the distance of what is left from the
   * planes of the triangles of the mesh that were there, the root of the mean of the squares
   * weighted by areas (Garland and Heckbert 1997). 0: what `vertices` needs. */
  double error = 0.0;
};

/** How to simplify a surface. */
struct SimplifyOptions
{
  /** Parts of the mesh whose vertices are all in the result, also if they are more than asked for;
   * then a note says so. */
  std::vector<Where> hold = {};
  /** Memory limit in bytes, at least 16 MiB; more where very many columns ask for that. */
  std::int64_t memoryLimit = std::int64_t(256) << 20;
  /** Threads; 0: one per core. The result does not depend on them, but on the memory limit. */
  int threads = 0;
  /** Compression of the result. */
  Codec codec = Codec::Zstd;
  bool text = false; ///< of the result: see WriteMeshOptions
  /** Folder for scratch files; empty: the system's temporary folder. */
  std::filesystem::path scratch = {};
  /** Most bytes of scratch files at once; 0: any number. */
  std::int64_t scratchLimit = 0;
  /**
   * Folder from which the same simplification, with any number of threads, continues if it was
   * killed: it is made, or must be empty or have the checkpoint, and is removed when the result is
   * complete. Empty: none. It needs a mesh that has a StoredMesh::fingerprint().
   */
  std::filesystem::path checkpoint = {};
  /** Progress callback; empty: none. */
  ProgressFunction progress = {};
};

/** What a simplification did and what it cost. */
struct SMG_EXPORT SimplifyReport
{
  std::int64_t vertices_before = 0; ///< of the mesh
  std::int64_t cells_before = 0;    ///< of the mesh
  std::int64_t vertices = 0;        ///< of the result
  std::int64_t cells = 0;           ///< triangles of the result
  /** The sum of the largest errors of its steps, see SimplifyTarget; NaN where vertices were
   * merged instead, since that is not measured. */
  double error = 0;
  std::int64_t dropped_bodies = 0;  ///< small bodies that are not in the result
  std::int64_t merged_vertices = 0; ///< with others near them, where edges could not collapse
  std::int64_t pool_bytes_peak = 0; ///< most accounted memory at once, bytes
  std::int64_t rss_bytes_peak = 0;  ///< largest resident memory of the process, bytes
  double cpu_seconds = 0;           ///< processor time of all threads of the process
  double seconds = 0;               ///< wall-clock time
  /** Vertices of the mesh that a killed program had simplified, from whose checkpoint this one
   * continued. */
  std::int64_t resumed_vertices = 0;
  std::vector<std::string> notes; ///< remarks for the user, a sentence each

  /** The report as a JSON object with the names above. */
  std::string json(int indent = 2) const;
};

/**
 * Simplifies a surface, or the outer surface of a solid, by collapsing edges, in a fixed amount of
 * memory whatever its size. Every vertex of the result is one of the mesh, where it was, with its
 * columns, and with its stream index in the column OriginalId if the mesh has no column of this
 * name. A triangle of the result is one of the mesh whose corners have moved, and has its columns
 * of cells; those of a solid do not give theirs to its surface, which a note says. Columns of one
 * integer that have at most 1,024 values, each of at least 4 cells on average, are labels: borders
 * between them are held as boundary curves are, unless `vertices` without `error` needs them, which
 * a note says. Boundary curves are kept as such, triangles are wound
 * as they are.
 *
 * Along seams, where vertices of the boundary coincide, the sides are simplified together, each
 * with its own vertices, so that they stay closed; patches that meet there are one body. Only if
 * the memory has no room for so many seams each side is simplified for itself, which a note says.
 *
 * The topology is that of the mesh: bodies, handles, boundary curves, no edge of more triangles. Of
 * a result that fits into the memory, edges of the smallest error collapse first, wherever they
 * are; of a larger one, in each part of the stream for itself. With `vertices` and without `error`,
 * the smallest bodies are left out so that the vertices are enough for 20 of each other body, or
 * all that it has, and handles, bumps, small holes and bodies go where they are smaller than the
 * errors of collapses, or the number cannot be reached otherwise; the result is manifold where the
 * mesh is. It has at most 19 vertices fewer than asked for, if the mesh has so many; one that does
 * not fit into the memory, or gives up borders or seams for the number, may have 5 % fewer.
 *
 * @param mesh the mesh, which is read once, and before that, if it is a surface or something is
 * held, to find seams and what is held
 * @param target how far to simplify
 * @param path the file to write, in the format of its suffix: any that meshes of triangles are
 * written in, with the columns that it can hold. In the order of the mesh
 * @param options how to simplify
 * @return what was done
 * @throws Error if the target or an option is out of range, the memory limit too low, or a file
 * fails
 * @throws Cancelled if the progress callback returns false. No file but the checkpoint remains
 * after an exception.
 */
SMG_EXPORT SimplifyReport simplify(const StoredMesh& mesh, const SimplifyTarget& target,
  const std::filesystem::path& path, const SimplifyOptions& options = {});

} // namespace smg
