// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/DisjointSets.h"
#include "Testing/Support/StreamMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg::testing
{

/** For each vertex the first one of its body. */
inline std::vector<std::int64_t> bodyOfVertices(const StreamMesh& mesh)
{
  DisjointSets<std::int64_t> sets(static_cast<std::size_t>(mesh.vertices()));
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    sets.join(mesh.corners[i], mesh.corners[i + 1]);
    sets.join(mesh.corners[i], mesh.corners[i + 2]);
  }
  std::vector<std::int64_t> bodies;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    bodies.push_back(sets.first(v));
  }
  return bodies;
}

} // namespace smg::testing
