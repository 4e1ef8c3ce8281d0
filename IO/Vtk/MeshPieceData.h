// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Columns.h"
#include "smg/MeshSource.h"
#include "smg/VsmReader.h"

#include "vtkStreamingMultigridIOModule.h"

#include <cstdint>

class vtkDataObject;
class vtkPointSet;

namespace smg
{

/** Fills an empty VTK mesh with the points, cells, arrays and contract arrays of a piece. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void setPiece(
  vtkPointSet& mesh, const MeshPiece& piece, const StreamInfo& info);

/** Of a mesh in one piece, where all points are final: filters would take it for a result. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void removeFinalized(vtkPointSet& mesh);

/** Marks the mesh, in its field data, as a preview of another. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void markAsPreview(vtkPointSet& mesh, const StreamInfo& full);

/** Marks the preview as that of a reader: streamed requests return the mesh itself. */
void markAsReaders(vtkPointSet& preview);

/** Whether the mesh is marked as a preview. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isPreview(vtkPointSet& mesh);

/** For what is made of the mesh behind a preview: the pipeline passes field data. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void removePreviewMarks(vtkPointSet& mesh);
/** For what is made of a preview. */
VTKSTREAMINGMULTIGRIDIO_EXPORT void copyPreviewMarks(vtkDataObject& preview, vtkDataObject& made);
/** Of a preview: the number of points of the mesh, and of its cells; 0 of other data. */
VTKSTREAMINGMULTIGRIDIO_EXPORT std::int64_t pointsBehind(vtkPointSet& mesh);
VTKSTREAMINGMULTIGRIDIO_EXPORT std::int64_t cellsBehind(vtkPointSet& mesh);
/** Whether the mesh is a preview of tetrahedra that consists of triangles of their surface. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool isSurfaceOfSolid(vtkPointSet& mesh);

/** Field arrays of a preview: 1, and the counts of the mesh that it represents. */
inline constexpr const char* PreviewName = "Preview";
inline constexpr const char* FullNumberOfPointsName = "FullNumberOfPoints";
inline constexpr const char* FullNumberOfCellsName = "FullNumberOfCells";

/** Field array of a preview of a reader, for which streamed requests return the mesh itself. The
 * plugin selects the writer by it. */
inline constexpr const char* PreviewOfReaderName = "PreviewOfReader";
inline constexpr int PreviewOfReaderComponents = 17;

} // namespace smg
