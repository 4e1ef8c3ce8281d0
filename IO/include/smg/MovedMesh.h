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

/** The treatment of the columns `Normals` of a mesh with moved vertices. */
enum class MovedNormals
{
  Recompute, ///< existing normals of triangles are recomputed, those of tetrahedra omitted
  Drop       ///< omitted
};

/** Options of the computation of normals. */
struct NormalsOptions
{
  /** Folder for the scratch file; empty: the system's temporary folder. */
  std::filesystem::path scratch;
  /** Bytes of memory for vertices that are not final; the excess is stored in scratch files. */
  std::int64_t memory = std::int64_t(64) << 20;
  ProgressFunction progress;
};

/** A mesh with moved vertices: the same stream with all its columns, with the positions of a
 * solution of three columns in the precision of the mesh, and with matching normals. */
class SMG_EXPORT MovedMesh
{
public:
  /**
   * Mesh and positions must outlive the object. Reads the mesh once if normals are computed.
   * @throws Error if a new position is not finite in the precision of the mesh, or a file fails;
   * Cancelled
   */
  MovedMesh(const VsmReader& mesh, Solution& positions, MovedNormals normals,
    const NormalsOptions& options = {});

  ~MovedMesh();

  /** The moved stream, from its first block; the bounds in its info are unknown. */
  std::unique_ptr<MeshSource> source() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace smg
