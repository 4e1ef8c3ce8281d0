// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Report.h"
#include "smg/Solve.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace smg
{

/** What becomes of the columns `Normals`, of vertices and cells, of a mesh whose vertices move. */
enum class MovedNormals
{
  /** Computed anew if the mesh has them: unit normals of the triangles, and at vertices their
   * means, weighted with the angles there. Of tetrahedra they are left out. */
  Recompute,
  Drop ///< left out
};

/** How normals are computed and cells judged. */
struct NormalsOptions
{
  /** Folder for the scratch file; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Memory for vertices that are not final, bytes; what exceeds it goes to scratch files. */
  std::int64_t memory = std::int64_t(64) << 20;
  /** Progress callback; empty: none. */
  ProgressFunction progress;
};

/**
 * A mesh with its vertices moved: the same stream with all its columns, but with the positions of a
 * solution of three columns, in the precision of the mesh, and with normals that fit. If the
 * solution winds triangles otherwise (SmoothingDescription::orient), they begin with any of their
 * corners, and a few vertices have other numbers in the stream, which are by first use.
 */
class SMG_EXPORT MovedMesh
{
public:
  /**
   * Reads the mesh once if vertex normals are to be computed.
   * @param mesh the mesh at rest; must outlive this
   * @param positions the new positions (x, y, z a vertex), as deform() returns them; must outlive
   * this
   * @param normals what becomes of normals
   * @param options how normals are computed
   * @throws Error if a new position is not finite in the precision of the mesh, or a file fails
   * @throws Cancelled if the progress callback returns false
   */
  MovedMesh(const StoredMesh& mesh, Solution& positions, MovedNormals normals,
    const NormalsOptions& options = {});

  ~MovedMesh();

  /**
   * The moved stream, from its first block. The bounds in its StreamInfo are not known (all 0).
   * Reading it throws Error as the constructor does. It must not outlive this.
   * @param report of the deformation: when the stream has been read to its end, the cells that it
   * inverts are added, with a note (Report::inverted); null: cells are not judged. Must outlive the
   * stream.
   */
  std::unique_ptr<MeshSource> source(Report* report = nullptr) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
