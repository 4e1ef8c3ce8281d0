// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace smg::benchmark
{

/**
 * What streaming a mesh in the order of a .vsm file requires: `span`, `width` (most vertices alive
 * at a cell) and `mean_window`, the mean over the vertices i of the largest neighbour of the
 * vertices up to i, less i. Needs about 30 bytes of memory per vertex and 2 per cell.
 */
nlohmann::json orderOfFile(const std::filesystem::path& vsm);

/**
 * The same for the mesh of the file in a breadth-first order made in core, where each component
 * starts at the last vertex of two searches and cells come as soon as their last vertex is reached.
 * Needs about 250 bytes of memory per triangle, 600 per tetrahedron.
 */
nlohmann::json orderInCore(const std::filesystem::path& vsm);

} // namespace smg::benchmark
