// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

class vtkPointSet;

namespace smg
{

/** Gives the points, cells, arrays and contract arrays of a piece to an empty VTK mesh. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void setPiece(
  vtkPointSet& mesh, const MeshPiece& piece, const StreamInfo& info);

/** Says in the field data that the mesh is a preview of another. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsPreview(vtkPointSet& mesh, const StreamInfo& full);

/** Marks the preview as that of a reader: streamed requests return the mesh itself. */
void markAsReaders(vtkPointSet& preview);

/** Whether the field data say that the mesh is a preview. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isPreview(vtkPointSet& mesh);

} // namespace smg
