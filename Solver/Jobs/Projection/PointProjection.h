// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Jobs/Projection/PointTree.h"
#include "Solver/Jobs/Projection/RingWindow.h"
#include "Solver/Mesh/StreamCheck.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Projects points to the nearest vertices of a mesh stream, in one pass over its blocks, and
 * determines the vertices that they influence. The result does not depend on the size of blocks.
 *
 * In memory are the data of each point, about 65,000 vertices or a block if that is larger, and
 * with rings a RingWindow of limited size.
 */
class SMG_EXPORT PointProjection
{
public:
  /** The range of influence of a point around its nearest vertex: the union of radius and rings. */
  struct Influence
  {
    double radius = 0.0; ///< distance, at least 0; 0: only vertices at the same position
    int rings = 0;       ///< edges, 0 to MaximumRings
    bool operator==(const Influence&) const = default;
  };
  static constexpr int MaximumRings = 100;
  static constexpr std::int64_t DefaultMemoryLimit = std::int64_t(256) << 20;

  /** The projection of a point. */
  struct Projected
  {
    std::int64_t vertex = -1; ///< stream index of the nearest vertex; the lowest of several
    std::array<double, 3> position{};
    double distance = std::numeric_limits<double>::infinity();
  };

  /**
   * `points` are x, y, z of each; `memoryLimit` is the memory limit for the rings in bytes. Throws
   * Error if one of the points or the radius is not finite, or if the radius or the rings are out
   * of range.
   */
  PointProjection(std::span<const double> points, const Influence& influence, CellType cellType,
    std::int64_t memoryLimit = DefaultMemoryLimit);

  /** Adds the next block of the stream. Throws Error if it is invalid, a position is not finite, or
   * the rings exceed the memory limit by more than a batch of vertices. */
  void add(const MeshBlock& block);

  /** To be called once after the last block. Throws Error if there was no vertex or the rings
   * exceed the memory limit; Cancelled by `progress`, which does not advance. */
  void finish(Progress& progress);
  void finish();

  /** The projection of each point, after finish(). */
  const std::vector<Projected>& projected() const { return this->Found; }

  /** The diagonal of the bounds of all vertices. */
  double diagonal() const;

  /** The points whose distance exceeds this part of the diagonal, in ascending order. */
  std::vector<std::int64_t> distantPoints(double part = 0.01) const;

  /** The point that influences the vertex, after finish(); -1: none. If there are several, it is
   * the one whose nearest vertex is nearest to this vertex, of equally near ones the first. */
  std::int64_t influencing(std::int64_t vertex, std::span<const double, 3> position) const;

private:
  void project();
  bool isInReach(std::size_t point, const std::array<double, 6>& bounds) const;
  std::vector<std::int64_t> nearestVertices() const;
  void forget();

  std::vector<double> Points;
  Influence Reach;
  std::int64_t MemoryLimit;
  StreamCheck Check;
  std::vector<Projected> Found;
  std::vector<double> Squared; ///< squared distance of each point to the nearest vertex so far

  /** Vertices that have not been compared with the points yet. */
  std::vector<double> Pending;
  std::int64_t FirstPending = 0;
  std::array<double, 6> Bounds;

  std::optional<RingWindow> Window; ///< if there are rings, until finish()
  std::int64_t BytesToForgetAt;     ///< of the window

  PointTree Anchors; ///< the vertices nearest to the points
  /** The vertices in rings in ascending order, each with the nearest of the points whose rings
   * contain it. */
  std::vector<std::pair<std::int64_t, std::int64_t>> InRings;
};

} // namespace smg
