// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"

#include <cstdint>
#include <string>

namespace smg
{

/**
 * Reads the mesh stream once and creates a preview: a small triangle mesh of the same shape, of at
 * most `maximumPoints` points (LeastPreviewPoints to MostPreviewPoints; typically 70 to 100 % of
 * it, above 500,000 at least half), by vertex clustering on a uniform grid. Each point is a vertex
 * of the mesh, with the columns of the stream and, as normal, the mean over the mesh around it, so
 * that the preview is shaded like the mesh. No vertex is a ghost. A mesh of fewer points is
 * returned unchanged; for tetrahedra, the outer surface. The order of the triangles may depend on
 * the C++ library; for a stream with unknown bounds (all 0), the grid depends on its first block.
 *
 * Memory is bounded by the preview and by the window of the stream. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

/** The error message for an empty preview of a mesh that is not empty. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

} // namespace smg
