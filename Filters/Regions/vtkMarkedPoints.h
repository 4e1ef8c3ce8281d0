// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/MarkedRegionSettings.h"
#include "Filters/Regions/vtkHeldPoints.h"

class vtkDataArray;
class vtkPointSet;

namespace smg
{

/** All points of the piece. */
HeldPoints heldEverywhere(vtkPointSet& piece);

/** The points that are marked by an array of the points. Throws Error if it has several components.
 */
HeldPoints heldByPointArray(
  vtkPointSet& piece, vtkDataArray& array, const MarkedRegionSettings& settings);

/** The points of the cells that are marked by an array of the cells, on a mesh that is whole.
 * Throws Error if it has several components. */
HeldPoints heldByCellArray(
  vtkPointSet& mesh, vtkDataArray& array, const MarkedRegionSettings& settings);

/**
 * The points of the boundary of a mesh that is whole, with cells of any types: those of the edges
 * of exactly one polygon, or, if there are solid cells, of the faces of exactly one of these. Cells
 * that are ghosts or flagged as duplicates do not count. On the surface preview of a solid, all
 * points.
 */
HeldPoints heldOnBoundary(vtkPointSet& mesh);

} // namespace smg
