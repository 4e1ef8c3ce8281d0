// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Solution.h"
#include "smg/VsmReader.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace smg
{

/** What becomes of the columns `Normals` of a mesh whose vertices move. */
enum class MovedNormals
{
  Recompute, ///< computed anew where the mesh has them, of triangles; left out of tetrahedra
  Drop       ///< left out
};

/** How normals are computed. */
struct NormalsOptions
{
  /** Folder for the scratch file; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Bytes of memory for the vertices that are not final; what exceeds it goes to scratch files. */
  std::int64_t memory = std::int64_t(64) << 20;
  ProgressFunction progress;
};

/**
 * A mesh with its vertices moved: the same stream with all its columns, with the positions, in the
 * precision of the mesh, that a solution of three columns says, and with normals that fit.
 */
class SMG_EXPORT MovedMesh
{
public:
  /**
   * Mesh and positions must live as long as this. Reads the mesh once if normals are computed.
   * @throws Error if a new position is not finite in the mesh's precision, or a file fails;
   * Cancelled
   */
  MovedMesh(const VsmReader& mesh, Solution& positions, MovedNormals normals,
    const NormalsOptions& options = {});

  ~MovedMesh();

  /** The moved stream, from its first block; of its info, the bounds are not known. */
  std::unique_ptr<MeshSource> source() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
