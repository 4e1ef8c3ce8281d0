// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include <cstdint>

class vtkPointSet;

namespace smg
{

/** Fills an empty VTK mesh with the points, cells, arrays and contract arrays of a piece. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void setPiece(
  vtkPointSet& mesh, const MeshPiece& piece, const StreamInfo& info);

/** Marks the mesh, in its field data, as a preview of another. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsPreview(vtkPointSet& mesh, const StreamInfo& full);

/** Marks the preview as that of a reader: streamed requests return the mesh itself. */
void markAsReaders(vtkPointSet& preview);

/** Whether the mesh is marked as a preview. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isPreview(vtkPointSet& mesh);

/** Of a preview: the number of points of the mesh, and of its cells; 0 of other data. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::int64_t pointsBehind(vtkPointSet& mesh);
VTKSTREAMINGMULTIGRIDIO_EXPORT std::int64_t cellsBehind(vtkPointSet& mesh);
/** Whether the mesh is a preview of tetrahedra that consists of triangles of their surface. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isSurfaceOfSolid(vtkPointSet& mesh);

} // namespace smg
