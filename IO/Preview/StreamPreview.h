// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"

#include <cstdint>
#include <string>
#include <vector>

namespace smg
{

/** A small triangle mesh in the shape of a mesh stream. */
struct StreamPreview
{
  /** Stream indices of the preview's points, ascending: each point is a vertex of the mesh. */
  std::vector<std::int64_t> ids;
  std::vector<double> positions; ///< x, y, z of each point
  /** x, y, z of each point's unit normal: the mean of the mesh around it, which shades the preview
   * as the mesh. */
  std::vector<float> normals;
  std::vector<std::int64_t> triangles; ///< three points (numbers in `ids`) a triangle
  std::vector<Column> vertexColumns;   ///< those of the mesh stream, a tuple a point
};

/**
 * Reads the mesh stream once and makes a preview of at most `maximumPoints` points
 * (LeastPreviewPoints to MostPreviewPoints; in general 70 to 100 % of it, above 500,000 at least
 * half) by vertex clustering on a uniform grid. A mesh of fewer points is shown as it is, and of a
 * stream of tetrahedra the outer surface. The order of the triangles may depend on the C++ library;
 * of a stream whose bounds are not known (all 0), the grid depends on its first block.
 *
 * Memory is bounded by the preview and by the window of the stream. Throws Error and Cancelled.
 */
SMG_EXPORT StreamPreview makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

/** What to say of a preview without a triangle that was made of more than nothing. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

} // namespace smg
