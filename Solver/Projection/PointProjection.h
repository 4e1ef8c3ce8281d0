// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Projection/PointTree.h"
#include "Solver/Projection/RingWindow.h"
#include "Solver/Stream/StreamCheck.h"
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
 * Projects points to the nearest vertices of a mesh stream, in one pass over its blocks, and tells
 * which vertices they influence. The result does not depend on how the stream is cut into blocks.
 *
 * Besides what it keeps for each point, memory is that of about 65,000 vertices, or of a block if
 * that is larger, and with rings that of a RingWindow, for which there is a limit.
 */
class SMG_EXPORT PointProjection
{
public:
  /** How far the influence of a point reaches, from the vertex nearest to it. Both add up. */
  struct Influence
  {
    double radius = 0.0; ///< distance, at least 0; 0: only what lies at the vertex's own place
    int rings = 0;       ///< edges, 0 to MaximumRings
    bool operator==(const Influence&) const = default;
  };
  static constexpr int MaximumRings = 100;
  static constexpr std::int64_t DefaultMemoryLimit = std::int64_t(256) << 20;

  /** Where a point came to. */
  struct Projected
  {
    std::int64_t vertex = -1; ///< stream index of the nearest vertex; the lowest of several
    std::array<double, 3> position{};
    double distance = std::numeric_limits<double>::infinity();
  };

  /**
   * `points`: x, y, z of each; `memoryLimit`: how many bytes finding the rings may take. Throws
   * Error if one of the points or the radius is not finite, or the radius or the rings are out of
   * range.
   */
  PointProjection(std::span<const double> points, const Influence& influence, CellType cellType,
    std::int64_t memoryLimit = DefaultMemoryLimit);

  /**
   * Takes the next block of the stream. Throws Error if that is not valid, a position is not
   * finite, or the rings need more memory than the limit, which may pass it by that of a batch of
   * vertices.
   */
  void add(const MeshBlock& block);

  /**
   * To be called once after the last block. Throws Error if there was no vertex, or the rings need
   * more memory than the limit; Cancelled by `progress`, which stays where it is.
   */
  void finish(Progress& progress);
  void finish();

  /** For each point, after finish(). */
  const std::vector<Projected>& projected() const { return this->Found; }

  /** The diagonal of the bounds of all vertices. */
  double diagonal() const;

  /** The points whose distance is more than this part of the diagonal, in ascending order. */
  std::vector<std::int64_t> distantPoints(double part = 0.01) const;

  /**
   * The point that influences the vertex, after finish(); -1: none does. Of several it is the one
   * whose nearest vertex is nearest to this one, of equally near ones the first.
   */
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
  std::vector<double> Squared; ///< squared distance to the nearest vertex so far, a point

  /** Vertices that the points have not been compared with yet. */
  std::vector<double> Pending;
  std::int64_t FirstPending = 0;
  std::array<double, 6> Bounds;

  std::optional<RingWindow> Window; ///< if there are rings, until finish()
  std::int64_t BytesToForgetAt;     ///< of the window

  PointTree Anchors; ///< the vertices nearest to the points
  /** Vertices in rings, each with the nearest of the points whose rings it is in; ascending. */
  std::vector<std::pair<std::int64_t, std::int64_t>> InRings;
};

} // namespace smg
