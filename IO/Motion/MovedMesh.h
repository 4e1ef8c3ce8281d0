// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/Vsm/VsmReader.h"
#include "IO/Motion/VertexNormals.h"
#include "Solver/Solve.h"

#include <memory>
#include <optional>

namespace smg
{

/** What becomes of the columns `Normals` of a mesh whose vertices move. */
enum class MovedNormals
{
  Recompute, ///< computed anew where the mesh has them, of triangles; left out of tetrahedra
  Drop       ///< left out
};

/**
 * A mesh with its vertices moved: the same stream with all its columns, with the positions, in the
 * precision of the mesh, that a solution of three columns says, and with normals that fit.
 */
class MovedMesh
{
public:
  /**
   * Mesh and positions must live as long as this. Reads the mesh once if normals are computed.
   * @throws Error if a new position is not finite in the mesh's precision, or a file fails;
   * Cancelled
   */
  MovedMesh(const VsmReader& mesh, Solution& positions, MovedNormals normals,
    const NormalsOptions& options = {});

  /** The moved stream, from its first block; of its info, the bounds are not known. */
  std::unique_ptr<MeshSource> source() const;

private:
  std::unique_ptr<MeshSource> withoutNormals() const;

  const VsmReader& Mesh;
  Solution& Positions;
  NormalsOptions Options;
  std::optional<VertexNormals> OfVertices; ///< if the stream has these
  bool OfCells = false;                    ///< whether the stream has these
};

} // namespace smg
