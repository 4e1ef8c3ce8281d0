// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/ChunkMarch.h"
#include "Solver/Jobs/Distance/EdgeFronts.h"
#include "Solver/Jobs/Distance/FrontQueue.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

/** Marches the exact front of a distance on a surface of triangles: see GeodesicMarch.cpp. */
class GeodesicMarch final : public ChunkMarch
{
public:
  GeodesicMarch(ChunkedMesh& mesh, Pool& pool);

  /** The bytes of a march over chunks with at most this many inner and crossing cells. Those of the
   * intervals are not known in advance: this is twice what they take on scans. */
  static std::int64_t bytes(const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells,
    std::int64_t crossingCells);

  /** Of intervals, and for each vertex of the window. */
  static constexpr std::int64_t LeastFrontBytes = 3 << 20, FrontBytes = 300;

private:
  /** The triangle of an edge that an interval's paths enter, in the frame of the edge. */
  struct Triangle
  {
    std::uint32_t corner; ///< opposite to the edge
    double x, y;
  };

  void settle(std::int64_t first, std::int64_t last) override;
  void begin(std::int64_t first, std::int64_t last);
  /** Offers the paths from a vertex along its edges, and through its triangles if paths may turn at
   * it. */
  void leave(std::uint32_t v);
  bool mayTurnAt(std::uint32_t v);
  double straightAngle();
  void leaveThrough(std::uint32_t v, std::uint32_t p, std::uint32_t q);
  void leaveCurve(std::uint32_t v, std::uint32_t w);
  /** Passes an interval on to the triangles of its edge. */
  void passOn(std::uint32_t number);
  void enter(const FrontInterval& interval, double length, const Triangle& triangle);
  void cross(FrontInterval interval, double length);
  /** Adds an interval to its edge, if it may be part of a shortest path. */
  void add(FrontInterval interval, double length);
  void wait(const FrontInterval& interval);
  /** `front`: flags Straight and OfRegion; `crossing`, `via`: see MarchWindow::arrive(). */
  void offer(std::uint32_t v, double distance, std::int64_t source, std::uint8_t front,
    const Vector& crossing, std::uint32_t via, const PathArrival& arrival);
  /** The point of an edge that is this share of it away from its first corner. */
  Vector pointOf(std::uint32_t first, std::uint32_t second, double share) const;
  bool isOfRegion(std::uint32_t v) const { return (this->Window.flags()[v] & OfRegion) != 0; }
  std::int64_t sourceOf(std::uint32_t v) const
  {
    return this->Window.source() ? this->Window.source()[v] : 0;
  }
  double lengthOf(std::uint32_t a, std::uint32_t b) const;

  /** How often the front may leave a vertex on average before distances that differ by more are
   * equal: so that the march ends whatever rounding does. */
  static constexpr std::int64_t MostLeft = 100;

  /** Distances that differ by less are equal, relative to them. */
  double Same = 1e-14;
  std::int64_t Left = 0; ///< vertices since that grew
  EdgeFronts Fronts;
  FrontQueue Queue;
  /** The pairs of neighbours of a vertex that a triangle joins, in both orders. */
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Around;
};

} // namespace smg
