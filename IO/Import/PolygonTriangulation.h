// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/PointStrips.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace smg
{

/**
 * Cuts a polygon in space into triangles: into the fan of its first corner if that covers it
 * without flat triangles, else by ears. The polygon is seen along the mean of its normals.
 *
 * A polygon of n corners has n - 2 triangles, three places in the polygon each. The places of a
 * triangle ascend, so that the triangles have the orientation of the polygon, and the polygon can
 * be restored from them (PolygonTree).
 */
class PolygonTriangulation
{
public:
  using Triangle = std::array<std::uint32_t, 3>;

  /** Approximate bytes for each corner. */
  static constexpr std::size_t BytesPerCorner = 160;

  /** `corners`: x, y, z of each, at least three corners. `poll` may throw, to cancel. */
  void cut(std::span<const double> corners, const std::function<void()>& poll);

  std::span<const Triangle> triangles() const& { return this->Triangles; }
  std::span<const Triangle> triangles() const&& = delete; ///< it would dangle
  /** Whether the triangles are the fan of the first corner. */
  bool isFan() const { return this->IsFan; }
  /** Whether they overlap, since the sides of the polygon cross. */
  bool overlaps() const;

private:
  using Point = std::array<double, 2>;

  /** A triangle that may be cut off: that of a corner with its neighbours. */
  struct Ear
  {
    double quality;
    std::uint32_t corner;
    std::uint32_t version; ///< of the corner: it has other neighbours in a later one

    bool operator<(const Ear& other) const
    {
      return this->quality != other.quality ? this->quality < other.quality
                                            : this->corner > other.corner;
    }
  };

  void project(std::span<const double> corners);
  double worstQuality() const;
  bool cutFan();
  bool windsOnce() const;
  void cutEars();
  bool cutRound();
  void buildStrips();
  void collectEars();
  void addEar(std::uint32_t corner);
  bool containsCorner(std::uint32_t ear);
  void count();
  void cutOff(std::uint32_t ear);
  double twiceArea(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  double qualityOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  std::vector<Point> Points;
  double TwiceArea = 0.0, Extent = 0.0; ///< of the polygon; the largest square of a distance in it
  std::vector<Triangle> Triangles;
  bool IsFan = true, Winds = false; ///< more than once around the first corner
  const std::function<void()>* Poll = nullptr;
  std::uint64_t Steps = 0;

  std::vector<std::uint32_t> Next, Previous, Version; ///< by corner; `Version` is Gone if cut off
  PointStrips Strips;                                 ///< of the corners that are left, and more
  double LeastQuality = 0.0;                          ///< of a convex corner
  std::vector<Ear> Ears;                              ///< a heap
};

} // namespace smg
