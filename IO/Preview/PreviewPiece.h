// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/StreamPreview.h"
#include "smg/Export.h"
#include "smg/VsmReader.h"

namespace smg
{

/**
 * The preview as a piece of triangles. Its vertices are neither ghosts nor used by another piece.
 */
SMG_EXPORT MeshPiece pieceOf(StreamPreview preview);

/**
 * Creates the preview of a mesh (see makePreview()) as a piece of triangles, with all vertex
 * columns and no cell columns. Its vertices are neither ghosts nor used by another piece. Takes one
 * pass over the mesh and one over its vertex columns. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreviewPiece(VsmReader& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

} // namespace smg
