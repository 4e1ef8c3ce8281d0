// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/AttributeNames.h"
#include "Solver/Files/CheckedFile.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/MovedMesh.h"

#include <cstdint>
#include <span>

namespace smg
{

/**
 * The unit normals at the vertices of a mesh stream of triangles, on disk: the mean of the
 * normals of a vertex's triangles, weighted by their angles at the vertex. Triangles without area,
 * and those marked as degenerate or duplicate in CellFlags, are ignored; a vertex without any other
 * has the normal (0, 0, 0).
 *
 * They are computed in one pass; a vertex is released as soon as it is final. The result does not
 * depend on the blocks of the stream.
 */
class SMG_EXPORT VertexNormals
{
public:
  /**
   * Reads the stream, which delivers at least its CellFlags, if any, to its end.
   * @throws Error if the cells are no triangles or a scratch file fails; Cancelled
   */
  explicit VertexNormals(MeshSource& mesh, const NormalsOptions& options = {});

  std::int64_t vertices() const { return this->Vertices; }
  /**
   * Writes the normals of the vertices [first, first + count) to `normals`, 3 floats per vertex.
   * Any range in any order. Throws Error.
   */
  void read(std::int64_t first, std::int64_t count, std::span<float> normals) const;

private:
  CheckedFile File;
  std::int64_t Vertices = 0;
};

} // namespace smg
