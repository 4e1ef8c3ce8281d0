// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace smg::benchmark
{

/** The mesh of a file of any format that importMesh() reads, in memory. */
testing::IndexedTestMesh readIndexed(const std::filesystem::path& path);

/**
 * Writes the mesh with single precision coordinates: triangles as binary PLY, tetrahedra as binary
 * legacy VTK. With a seed, vertices and cells are in random order. At most 2^31 - 1 vertices and
 * cells. Needs 8 bytes of memory per vertex and 4 per cell. Throws Error.
 */
void writeIndexed(const testing::IndexedTestMesh& mesh, const std::filesystem::path& path,
  std::optional<std::uint64_t> shuffleSeed = {});

} // namespace smg::benchmark
