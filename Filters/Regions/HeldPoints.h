// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Pieces/PieceRequest.h"
#include "Filters/Regions/KeptSelection.h"
#include "Filters/Regions/RegionSettings.h"
#include "IO/Vtk/PieceInput.h"
#include "Solver/Core/Progress.h"
#include "Solver/Jobs/Projection/PointProjection.h"

#include "vtkBoundingBox.h"
#include "vtkPointSet.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

class vtkSelection;
class vtkImplicitFunction;

namespace smg
{

/** The held points of a piece and their holders. A *holder* is a point of the region: a selected
 * point, an id, a position, or the region as a whole. */
struct HeldPoints
{
  std::vector<std::int64_t> by; ///< index of the holder of each point; -1: free
  std::int64_t holders = 0;
  /** The position of the mesh point at each holder; empty: each point is its own anchor. */
  std::vector<double> anchors;
};

/** The held points of a displayed mesh, kept as long as the request, the stamp and the number of
 * points are the same: a filter that takes points away gives others to whoever solves. */
class KeptHeldPoints
{
public:
  /** Those that are kept, or else those that `find()` returns. */
  template <class Find>
  const HeldPoints& of(
    vtkPointSet& mesh, const PieceRequest& request, const InputStamp& stamp, Find&& find)
  {
    const vtkIdType points = mesh.GetNumberOfPoints();
    if (!this->IsKept || this->Stamp != stamp || this->Piece != request.Piece ||
        this->Pieces != request.Pieces || this->IsStreamed != request.IsStreamed ||
        this->Points != points)
    {
      this->reset(); // find() may throw
      this->Held = find();
      this->Stamp = stamp;
      this->Piece = request.Piece;
      this->Pieces = request.Pieces;
      this->IsStreamed = request.IsStreamed;
      this->Points = points;
      this->IsKept = true;
    }
    return this->Held;
  }

  void reset() { *this = {}; }

private:
  HeldPoints Held;
  InputStamp Stamp;
  int Piece = 0, Pieces = 1;
  bool IsStreamed = false;
  vtkIdType Points = 0;
  bool IsKept = false;
};

/** The points of the mesh whose `ids` (one per point) are in the list. */
HeldPoints heldByIds(std::span<const std::int64_t> ids, const IdList& sought);

/** The points of the mesh, with their stream indices, in the range of the projected points. */
HeldPoints heldByProjection(
  vtkPointSet& mesh, std::span<const std::int64_t> indices, const PointProjection& projection);

/** Counts the held points of the requested pieces, as long as these are requested in order. */
class HeldCount
{
public:
  /**
   * Counts those that the piece owns. Restarts unless this is the next of streamed pieces requested
   * in order.
   * @return whether the whole mesh has been counted now
   */
  bool add(vtkPointSet& piece, const HeldPoints& held, const PieceRequest& request);

  /** The number of held points. */
  std::int64_t points() const { return this->Points; }
  /** The number of all points, held or not. */
  std::int64_t allPoints() const { return this->AllPoints; }
  /** The bounds of the held points; not valid if there are none. */
  const vtkBoundingBox& bounds() const { return this->Bounds; }
  /** The holders that hold points among these. */
  const std::vector<char>& isHolding() const { return this->IsHolding; }

private:
  std::int64_t Points = 0, AllPoints = 0;
  vtkBoundingBox Bounds;
  std::vector<char> IsHolding;
  int Pieces = 0; ///< streamed in order; 0: none
  int NextPiece = 0;
};

/** The data in which a region is searched. */
struct RegionContext
{
  PieceInput& input; ///< of the region filter
  /** The mesh to search: the same points as those of the input. */
  PieceInput& mesh;
  vtkSelection* selection; ///< nullptr: not connected
  KeptSelection& kept;
  std::function<InputStamp()> stamp; ///< of the current mesh and selection
  Progress& progress;
  std::function<void(const std::string&)> warn;
};

/**
 * Holds the points where the function is at most 0, or (`isInsideOut`) at least 0. Throws Error if
 * there is no function, if it is a sphere or a cylinder with a radius that is not greater than 0,
 * or if it is not finite at a point.
 */
HeldPoints heldByFunction(vtkImplicitFunction* function, bool isInsideOut, vtkPointSet& piece);

} // namespace smg
