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
 * Reads the mesh stream once and makes a preview: a small triangle mesh in its shape, of at most
 * `maximumPoints` points (LeastPreviewPoints to MostPreviewPoints; in general 70 to 100 % of it,
 * above 500,000 at least half), by vertex clustering on a uniform grid. Each point is a vertex of
 * the mesh, with the columns of the stream and, as normal, the mean of the mesh around it, which
 * shades the preview as the mesh. The piece stands alone: no vertex is a ghost. A mesh of fewer
 * points is shown as it is, and of a stream of tetrahedra the outer surface. The order of the
 * triangles may depend on the C++ library; of a stream whose bounds are not known (all 0), the grid
 * depends on its first block.
 *
 * Memory is bounded by the preview and by the window of the stream. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

/** What to say of a preview without a triangle that was made of more than nothing. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

} // namespace smg
