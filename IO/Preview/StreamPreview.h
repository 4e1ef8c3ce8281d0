// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Stream/MeshSource.h"

#include <cstdint>
#include <vector>

namespace smg
{

/** A small triangle mesh in the shape of a mesh stream. */
struct StreamPreview
{
  /** Stream indices of the preview's points, ascending: each point is a vertex of the mesh. */
  std::vector<std::int64_t> ids;
  std::vector<double> positions;       ///< x, y, z of each point
  std::vector<std::int64_t> triangles; ///< three points (numbers in `ids`) a triangle
};

/** Number of points of a preview where nothing else is asked for. */
inline constexpr std::int64_t DefaultPreviewPoints = 20000;

/**
 * Reads the mesh stream once and makes a preview of at most `maximumPoints` points (at least 8;
 * in general a quarter of it to all of it) by vertex clustering on a uniform grid. Of a stream of
 * tetrahedra, the outer surface is shown. The order of the triangles may depend on the C++ library.
 *
 * Memory is bounded by the preview and by the window of the stream. Throws Error and Cancelled.
 */
StreamPreview makePreview(MeshSource& mesh, std::int64_t maximumPoints = DefaultPreviewPoints,
  const ProgressFunction& progress = {});

} // namespace smg
