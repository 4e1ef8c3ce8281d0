// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Preview.h"
#include "smg/VsmReader.h"

namespace smg
{

/** What a preview of tetrahedra consists of. */
enum class SolidPreviewCells
{
  Triangles, ///< of the outer surface: see makePreview()
  Tetrahedra ///< see makeSolidPreview()
};

/**
 * Creates the preview of a mesh with all its vertex columns. Takes one pass over the mesh, or two
 * for tetrahedra of a solid, and one over its vertex columns. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreviewPiece(VsmReader& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {},
  SolidPreviewCells cells = SolidPreviewCells::Triangles);

} // namespace smg
