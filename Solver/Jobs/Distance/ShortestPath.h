// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Jobs/Distance/MarchWindow.h"
#include "smg/Report.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/** Follows the shortest path from a vertex back to its source, after a march of exact distances
 * that has stored how paths arrive (ChunkPlan::arrivals). Moves the window along the path. */
class ShortestPath
{
public:
  ShortestPath(MarchWindow& window, Progress& progress)
    : Window(window)
    , Reported(progress)
  {
  }

  /** The path to a vertex of the stream; without points if no source reaches it, or if it cannot be
   * followed, which is not expected. Its length is the distance always. Its number is left to the
   * caller. Throws Cancelled. */
  Report::Path to(std::int64_t vertex);

private:
  /** No vertex: the path has ended at the edge between two sources. */
  static constexpr std::uint32_t None = MarchWindow::NoVertex;

  /** An edge that the path crosses. */
  struct Crossing
  {
    std::uint32_t a, b;   ///< the corners: places in the window
    std::uint32_t passed; ///< the third corner of the triangle that has been passed
    FrontImage image;     ///< where the path goes to, in the frame from `a` to `b`
    double at = 0;        ///< where it crosses, in this frame
    double length = 0;    ///< of the edge
    double left() const { return this->image.at(this->at); }
    /** Whether the path may go on. An image on the edge is the middle corner of a triangle without
     * area beyond. */
    bool isAhead() const
    {
      return this->length > 0 && (this->image.depth > 0 || !this->image.isStraight);
    }
  };

  /** Shows all triangles of the edge between two vertices that are shown. */
  void showAround(std::uint32_t a, std::uint32_t b);
  /** Follows the straight part from a vertex on, and returns the next vertex on the path. */
  std::uint32_t passStraight(std::uint32_t vertex);
  /** The same from an edge on; nothing if it leads nowhere. */
  std::optional<std::uint32_t> follow(Crossing crossing);
  /** At an edge of several triangles: that by which the path arrives. */
  std::optional<std::uint32_t> followOneOf(
    const Crossing& crossing, const std::vector<std::uint32_t>& corners);
  Crossing firstCrossing(std::uint32_t vertex) const;
  /** The corners of the triangles beyond an edge; none at the boundary. */
  std::vector<std::uint32_t> cornersBeyond(const Crossing& crossing) const;
  /** The crossing of the other edge of the triangle beyond with this corner. */
  Crossing next(Crossing crossing, std::uint32_t corner) const;
  /** Whether the path has come straight to where so much is left. */
  bool isStraight(double left) const;
  /** Whether an edge at which the path may end is a source. */
  bool isSource(const Crossing& crossing) const;
  /** Whether the path that goes straight to a vertex of the triangle it is in is as short as what
   * is left. */
  bool isBy(std::uint32_t vertex, double left) const;
  /** Whether that vertex is too far from the sources for the path to be in its triangle. */
  bool isTooFar(std::uint32_t vertex, double left) const;
  double wayTo(std::uint32_t vertex) const;
  void add(const Vector& point);

  MarchWindow& Window;
  std::int64_t Middle = -1; ///< of the chunks that are shown
  Progress& Reported;
  Report::Path Path;
  double Rounding = 0;    ///< of lengths, by that of coordinates
  double Whole = 0;       ///< the distance of the vertex from which the straight part comes
  double Before = 0;      ///< the length of the path up to that vertex
  std::int64_t Left = 0;  ///< triangles that it may still try
  bool HasForked = false; ///< whether it has crossed an edge of several triangles
};

} // namespace smg
