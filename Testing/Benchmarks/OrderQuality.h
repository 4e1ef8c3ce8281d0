// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace smg::benchmark
{

/**
 * What whoever streams a mesh in the order of a .vsm file holds: `span`, `width` (most vertices
 * alive at a cell) and `mean_window`, the mean over the vertices i of the largest neighbour of the
 * vertices up to i, less i. About 30 bytes a vertex and 2 a cell of memory.
 */
nlohmann::json orderOfFile(const std::filesystem::path& vsm);

/**
 * The same of the mesh of the file in a breadth-first order made in core, each component begun at
 * the last vertex of two searches; cells as soon as their last vertex is reached. About 250 bytes a
 * triangle of memory, 600 a tetrahedron.
 */
nlohmann::json orderInCore(const std::filesystem::path& vsm);

} // namespace smg::benchmark
