// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace smg
{

/** Counts of a mesh from its ordering. -1: not counted. */
struct MeshCounts
{
  std::int64_t isolatedVertices = 0;
  std::int64_t components = -1;          ///< connected by edges
  std::int64_t boundaryEdges = -1;       ///< of one triangle; -1 for tetrahedra
  std::int64_t nonManifoldEdges = -1;    ///< of more than two triangles; -1 for tetrahedra
  std::int64_t nonManifoldVertices = -1; ///< see VertexStar; -1 for tetrahedra
};

} // namespace smg
