// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>

namespace smg::testing
{

/** The mesh with vertices of its own for each cell. */
inline IndexedTestMesh unwelded(const IndexedTestMesh& mesh)
{
  IndexedTestMesh apart{ mesh.cellType, {}, {} };
  for (const std::int64_t corner : mesh.corners)
  {
    apart.corners.push_back(apart.vertices());
    const auto point = mesh.positions.begin() + 3 * corner;
    apart.positions.insert(apart.positions.end(), point, point + 3);
  }
  return apart;
}

} // namespace smg::testing
