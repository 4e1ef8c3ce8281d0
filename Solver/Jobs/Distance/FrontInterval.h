// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace smg
{

// The front of a distance on a surface of triangles, exactly: on each edge it consists of intervals
// that straight paths from one point cross (the windows of Mitchell, Mount and Papadimitriou, The
// discrete geodesic problem, 1987). The triangles between the point and the edge, unfolded into the
// plane of the edge, show the point at one place, its image; the distance of a point of the
// interval is that from the image, and of the image from the sources (its offset). An edge of a
// curve of sources has its image at infinity: the front is straight.
//
// The frame of an edge has its origin at one end and the other end at x = length. Images lie below
// (y < 0), the triangle that the paths enter lies above.

/** The length of a vector, whose square must not overflow. */
inline double norm(double x, double y)
{
  return std::sqrt(x * x + y * y);
}

/** A point in the frame of an edge, on either side of it: how far along the edge, and beside it. */
struct FramePoint
{
  double x, y;
};

/** Of a point, from the origin of the edge, of the vector and the length of that. */
inline FramePoint inFrame(const Vector& to, const Vector& edge, double length)
{
  const Vector normal = cross(edge, to);
  return { dot(edge, to) / length, std::sqrt(dot(normal, normal)) / length };
}

/** Where the paths of an interval come from, in the frame of its edge. */
struct FrontImage
{
  double x = 0;      ///< of a round front, the place of the image; of a straight one, the direction
  double depth = 0;  ///< how far below the edge, at least 0; of a straight front, of the direction
  double offset = 0; ///< the distance of the image; of a straight front, that at the origin
  bool isStraight = false;

  /** The distance of a point of the frame, with y >= 0. */
  double at(double px, double py = 0) const
  {
    return this->isStraight ? this->offset + this->x * px + this->depth * py
                            : this->offset + norm(px - this->x, py + this->depth);
  }
  /** The distance at the point of an interval that is nearest. */
  double least(double begin, double end) const
  {
    const double nearest =
      this->isStraight ? (this->x > 0 ? begin : end) : std::clamp(this->x, begin, end);
    return this->at(nearest);
  }
  /** In the frame from the other end of an edge of this length. */
  FrontImage reversed(double length) const
  {
    return this->isStraight
             ? FrontImage{ -this->x, this->depth, this->offset + this->x * length, true }
             : FrontImage{ length - this->x, this->depth, this->offset, false };
  }
  /** Where the path to a point above the edge crosses the edge. An image on the edge is that place
   * itself. */
  double crossing(double px, double py) const
  {
    return this->isStraight
             ? px - py * this->x / this->depth
             : this->x +
                 (this->depth > 0 ? (px - this->x) * (this->depth / (this->depth + py)) : 0);
  }
  /** The image in the frame of the edge from the origin to a point above the edge, beyond which the
   * path goes on; that edge has this length. */
  FrontImage beyond(double px, double py, double length) const
  {
    const double cosine = px / length, sine = py / length;
    if (this->isStraight)
    {
      return { this->x * cosine + this->depth * sine,
        std::max(0.0, this->depth * cosine - this->x * sine), this->offset, true };
    }
    return { this->x * cosine - this->depth * sine,
      std::max(0.0, this->depth * cosine + this->x * sine), this->offset, false };
  }
  /** The share of the edge from the origin to a point above the edge, where the path through (x, 0)
   * crosses it: 0 to 1. */
  double shareBeyond(double px, double py, double at) const
  {
    const double way =
      this->isStraight ? px * this->depth - py * this->x : px * this->depth - py * (at - this->x);
    const double along = this->depth * at;
    return along <= 0 ? 0 : along < way ? along / way : 1;
  }
};

/** Where two fronts have the same distance, within the open range of an edge: ascending, at most
 * two, some of which may not be such points. Returns their number. */
inline int crossings(const FrontImage& a, const FrontImage& b, double begin, double end, double* at)
{
  // (m + k x)^2 = e ((x - c)^2 + h), x from the beginning of the range on.
  double m, k, e, c, h;
  if (a.isStraight && b.isStraight)
  {
    const double slope = a.x - b.x;
    const double x = slope != 0 ? (b.at(begin) - a.at(begin)) / slope : -1;
    at[0] = begin + x;
    return x > 0 && at[0] < end ? 1 : 0;
  }
  if (a.isStraight || b.isStraight)
  {
    const FrontImage& straight = a.isStraight ? a : b;
    const FrontImage& round = a.isStraight ? b : a;
    m = straight.at(begin) - round.offset;
    k = straight.x;
    e = 1;
    c = round.x - begin;
    h = round.depth * round.depth;
  }
  else
  {
    const double more = b.offset - a.offset, ax = a.x - begin, bx = b.x - begin;
    m = 0.5 * ((ax - bx) * (ax + bx) + (a.depth - b.depth) * (a.depth + b.depth) - more * more);
    k = bx - ax;
    e = more * more;
    c = bx;
    h = b.depth * b.depth;
  }
  const double p = k * k - e, q = m * k + e * c, r = m * m - e * (c * c + h);
  // q^2 - p r, without its cancellation.
  const double square = e * ((m + k * c) * (m + k * c) + p * h);
  if (!(square >= 0))
  {
    return 0;
  }
  // The root without cancellation, and the other one by their product.
  const double sum = -(q + std::copysign(std::sqrt(square), q));
  double roots[2] = { sum != 0 ? r / sum : -1, p != 0 ? sum / p : -1 };
  if (roots[1] < roots[0])
  {
    std::swap(roots[0], roots[1]);
  }
  int count = 0;
  for (const double root : roots)
  {
    if (root > 0 && begin + root < end && (count == 0 || begin + root > at[0]))
    {
      at[count++] = begin + root;
    }
  }
  return count;
}

/** An interval of an edge, whose paths go on into all triangles of the edge but the one they come
 * from. */
struct FrontInterval
{
  static constexpr std::uint32_t None = 0xffffffff;

  double begin, end; ///< from the first corner of the edge on
  FrontImage image;
  std::int64_t source;         ///< the number of the source
  std::uint32_t first, second; ///< the corners of the edge: places in a window, ascending
  std::uint32_t from; ///< the corner opposite to the edge of the triangle that the paths come from
  bool isOfRegion;    ///< whether the source is one of a region
};

/** How the shortest path arrives at a vertex: across an edge, from an image in the plane of the
 * triangle beyond it, or along an edge. */
struct PathArrival
{
  std::uint32_t first = FrontInterval::None, ///< the corners of the edge that is crossed,
    second = FrontInterval::None;            ///< or twice the other end of the edge along which
  FrontImage image;                          ///< in the frame of the edge that is crossed
};

} // namespace smg
