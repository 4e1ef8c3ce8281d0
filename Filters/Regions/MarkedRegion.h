// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/RegionSettings.h"
#include "Solver/Problem/FixedVertices.h"

#include <memory>
#include <optional>
#include <string>

class vtkDataArray;
class vtkPointSet;

namespace smg
{

/** A region of the boundary, or of points or cells marked by an array. An array of the points marks
 * those of any piece. What an array of the cells marks, and the boundary, cross the pieces of a
 * streamed mesh: they are found in a pass over all of them. */
class MarkedRegion
{
public:
  /** Sets the settings; results for other settings are discarded. */
  void set(const MarkedRegionSettings& settings);

  /**
   * Updates the input to the requested piece and determines its held points. What requires the
   * whole mesh is computed first and kept until the settings or the stamp change. Throws Error and
   * Cancelled.
   */
  vtkPointSet& fetchPiece(
    const PieceRequest& request, const RegionContext& context, HeldPoints& held);

private:
  /** The held points of the whole mesh. */
  struct Found
  {
    InputStamp stamp;
    std::unique_ptr<SelectedVertices> vertices;
  };

  /** Whether the held points of the piece depend on its own cells alone. Throws Error if those of
   * other pieces are needed, but the pieces have no common numbers. */
  bool isByItself(vtkPointSet& piece, const PieceRequest& request) const;
  HeldPoints holdShown(vtkPointSet& mesh) const;
  void find(const RegionContext& context);

  MarkedRegionSettings Asked;
  KeptHeldPoints OnDisplay; ///< of a mesh that is shown
  std::optional<Found> OnMesh;
};

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

/** The points of a group of a mesh that is whole: of its facets, else of its points, else of its
 * cells. Throws Error if there is none of this name. */
HeldPoints heldByGroup(vtkPointSet& mesh, const std::string& name);

/**
 * The points of the boundary of a mesh that is whole, with cells of any types: those of the edges
 * of exactly one polygon, or, if there are solid cells, of the faces of exactly one of these. Cells
 * that are ghosts or flagged as duplicates do not count. On the surface preview of a solid, all
 * points.
 */
HeldPoints heldOnBoundary(vtkPointSet& mesh);

} // namespace smg
