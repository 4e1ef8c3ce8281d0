// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Projection/VertexGraph.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * The part of a mesh stream that lies within some edges of chosen vertices, its centers. These are
 * chosen while the stream goes by, and may change until its end.
 *
 * Memory is that of the part: of the vertices, not of the centers whose rings they are in. To it
 * belongs what lies within the rings of a vertex that is not final, and what came since forget()
 * was called. It is the whole mesh if the stream does not say which vertices are final.
 */
class RingWindow
{
public:
  /** `rings`: how many edges away the vertices may be, at least 1. */
  RingWindow(CellType cellType, int rings);

  /** Takes the next block of a valid stream. */
  void add(const MeshBlock& block);

  /** No cell follows: every vertex is final. */
  void finish();

  /**
   * Forgets what lies outside the rings of the centers and of vertices that are not final. Only
   * these centers and vertices that are yet to come may be centers later.
   */
  void forget(std::span<const std::int64_t> centers);

  /** The bytes that the window and the walks in it need. */
  std::int64_t bytes() const;

  /** How many cells it remembers. */
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->Corners.size() / this->CornersOfCell);
  }

  /**
   * The vertices within the rings of centers, after finish(), in ascending order, each with the
   * number of the center that is nearest to it in space, of equally near ones the first. `progress`
   * stays where it is; it may cancel.
   */
  std::vector<std::pair<std::int64_t, std::int64_t>> nearestCenters(
    std::span<const std::int64_t> centers, Progress& progress) const;

private:
  struct Nearest
  {
    std::int64_t center = -1;
    double squaredDistance = 0.0;
  };

  std::int64_t vertices() const { return static_cast<std::int64_t>(this->Positions.size() / 3); }
  std::int64_t idOf(std::int64_t place) const;
  std::int32_t placeOf(std::int64_t id) const;
  std::span<const double, 3> positionAt(std::int32_t place) const;
  VertexGraph graph() const;
  std::vector<Nearest> nearestAtPlaces(
    std::span<const std::int64_t> centers, Progress& progress) const;
  void keepCells(const std::vector<std::uint8_t>& isInner);
  std::vector<std::int32_t> keepVertices(const std::vector<std::uint8_t>& isKept);

  std::size_t CornersOfCell;
  int Rings;
  std::int64_t Finalized = 0;

  /**
   * Vertices have places in the window, in the order of their stream indices: first those below
   * FirstRecent, which are listed, then all from there on.
   */
  std::vector<std::int64_t> Listed;
  std::int64_t FirstRecent = 0;
  std::vector<double> Positions;     ///< x, y, z of each vertex
  std::vector<std::int32_t> Corners; ///< places of the vertices of each cell
};

} // namespace smg
