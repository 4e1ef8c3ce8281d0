// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>
#include <filesystem>

namespace smg::benchmark
{

/**
 * Writes a binary PLY file of the mesh with every edge in `parts` (at least 1) and every triangle
 * in parts^2 equal ones, vertices and cells in random order. Neither the mesh made nor its order is
 * ever in memory. The file holds at most 2^31 - 1 vertices and cells. Throws Error.
 */
void writeSplit(const testing::IndexedTestMesh& triangles, std::int64_t parts,
  const std::filesystem::path& path, std::uint64_t seed);

} // namespace smg::benchmark
