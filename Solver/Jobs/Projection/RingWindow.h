// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/** The neighbours of each vertex of a part of a mesh, and walks along its edges. */
class VertexGraph
{
public:
  /** `corners` are the vertices of each cell, from 0 to `vertices` - 1; fewer than 2^31 vertices
   * and cells. */
  VertexGraph(std::span<const std::int32_t> corners, int cornersOfCell, std::int64_t vertices);

  /** Each neighbour once. */
  std::span<const std::int32_t> neighbours(std::int32_t vertex) const
  {
    const auto begin = static_cast<std::size_t>(this->Begins[vertex]);
    return std::span(this->Neighbours).subspan(begin, this->Begins[vertex + 1] - begin);
  }

  /**
   * Appends to `found` all vertices within `rings` edges of its content, nearer ones first, and
   * marks them in `isFound`, where the initial content must be marked.
   * @return the index in `found` of the first vertex at `rings` edges
   */
  std::size_t walk(
    int rings, std::vector<std::int32_t>& found, std::vector<std::uint8_t>& isFound) const;

private:
  std::vector<std::int64_t> Begins; ///< begin of each vertex, and the end
  std::vector<std::int32_t> Neighbours;
};

/**
 * The part of a mesh stream within a number of edges of chosen vertices, the centers. These are
 * chosen while the stream is read, and may change until its end.
 *
 * The memory is proportional to the number of vertices in that part, however many rings overlap
 * there. It includes the rings of vertices that are not final, and everything that has been added
 * since the last call of forget(). If the stream does not mark final vertices, it is the whole
 * mesh.
 */
class RingWindow
{
public:
  /** `rings` is the maximum number of edges from a center, at least 1. */
  RingWindow(CellType cellType, int rings);

  /** Adds the next block of a valid stream. */
  void add(const MeshBlock& block);

  /** Ends the stream: every vertex is final. */
  void finish();

  /** Discards everything outside the rings of the centers and of vertices that are not final. Only
   * these centers and later vertices may be centers afterwards. */
  void forget(std::span<const std::int64_t> centers);

  /** The bytes required by the window and by walks in it. */
  std::int64_t bytes() const;

  /** The number of cells in the window. */
  std::int64_t cells() const
  {
    return static_cast<std::int64_t>(this->Corners.size() / this->CornersOfCell);
  }

  /**
   * The vertices within the rings of centers, after finish(), in ascending order, each with the
   * index of the nearest center in space; of equally near ones, the first. `progress` does not
   * advance; it may cancel.
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

  /** Vertices have indices in the window, in the order of their stream indices: first those below
   * FirstRecent, which are listed, then all from there on. */
  std::vector<std::int64_t> Listed;
  std::int64_t FirstRecent = 0;
  std::vector<double> Positions;     ///< x, y, z of each vertex
  std::vector<std::int32_t> Corners; ///< window indices of the vertices of each cell
};

} // namespace smg
