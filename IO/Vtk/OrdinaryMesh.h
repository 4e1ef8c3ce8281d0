// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkStreamingMultigridIOModule.h" // For export macro

#include "smg/Convert.h"

#include "vtkSmartPointer.h"

#include <filesystem>

class vtkDataObject;
class vtkPointSet;

namespace smg
{

/** Whether this process is one of several, each of which may have its own pieces. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool hasSeveralProcesses();

/** Whether the mesh is not a piece of a mesh stream: it has no point GlobalIds, or, in a program of
 * one process and not a preview, some that do not number its own points consecutively in the order
 * in which its cells use them first, as those behind a filter that has taken points away
 * (Threshold), joined meshes or given numbers of its own. */
VTKSTREAMINGMULTIGRIDIO_EXPORT bool lacksStreamNumbering(vtkDataObject& data);

/** Which cells of a mesh count: the solid ones, or without these those of surfaces. */
VTKSTREAMINGMULTIGRIDIO_EXPORT CellChoice countingCells(vtkPointSet& mesh);

/** The mesh that writeOrdinaryMesh() makes, before it is made, as far as the counts of points and
 * cells and the arrays of the points tell; no width and span. */
VTKSTREAMINGMULTIGRIDIO_EXPORT StreamInfo ordinaryMeshInfo(vtkPointSet& mesh);

/** The mesh without the arrays of original numbers, which would be taken for those of its own
 * points and cells. */
VTKSTREAMINGMULTIGRIDIO_EXPORT vtkSmartPointer<vtkPointSet> withoutOriginalNumbers(
  vtkPointSet& mesh);

/** Writes a whole mesh in memory with its arrays, of solids and surfaces the solids. Throws like
 * convertArrays(). */
VTKSTREAMINGMULTIGRIDIO_EXPORT ConversionReport writeOrdinaryMesh(
  vtkPointSet& mesh, const std::filesystem::path& path, const ConversionOptions& options);

} // namespace smg
