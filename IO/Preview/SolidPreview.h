// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"

#include <cstdint>

namespace smg
{

/**
 * Creates a preview of a tetrahedral mesh: a coarse tetrahedral mesh of at most `maximumPoints`
 * points, each of them a vertex of the mesh, by vertex clustering on a body-centred cubic grid (see
 * SolidClusters). A mesh of so few vertices is returned as it is, without cells that have no
 * volume; of others there is at most one point for 20 vertices, since the cells of the grid must be
 * larger than those of the mesh. Parts that are thinner than two or three cells of the grid vanish.
 *
 * Reads the mesh twice, rarely a third time. Memory is bounded by the preview and by the window of
 * the stream. The columns of the vertices are not set. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makeSolidPreview(const StoredMesh& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

} // namespace smg
