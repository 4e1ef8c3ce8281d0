// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Preview/StreamPreview.h"
#include "smg/Export.h"
#include "smg/VsmReader.h"

namespace smg
{

/**
 * Creates the preview of a mesh (see makePreview()) with all its vertex columns. Takes one pass
 * over the mesh and one over its vertex columns. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreviewPiece(VsmReader& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {});

} // namespace smg
