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
  /** The stream indices of the points, ascending: each point is a vertex of the mesh. */
  std::vector<std::int64_t> ids;
  std::vector<double> positions; ///< x, y, z per point
  /** x, y, z of the unit normal of each point: the mean over the mesh around it, so that the
   * preview is shaded like the mesh. */
  std::vector<float> normals;
  std::vector<std::int64_t> triangles; ///< three points (indices in `ids`) per triangle
  std::vector<Column> vertexColumns;   ///< those of the mesh stream, a tuple per point
};

/**
 * Reads the mesh stream once and creates a preview of at most `maximumPoints` points
 * (LeastPreviewPoints to MostPreviewPoints; typically 70 to 100 % of it, above 500,000 at least
 * half) by vertex clustering on a uniform grid. A mesh of fewer points is returned unchanged; for
 * tetrahedra, the outer surface. The order of the triangles may depend on the C++ library; for a
 * stream with unknown bounds (all 0), the grid depends on its first block.
 *
 * Memory is bounded by the preview and by the window of the stream. Throws Error and Cancelled.
 */
SMG_EXPORT StreamPreview makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

/** The error message for an empty preview of a mesh that is not empty. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

} // namespace smg
