// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{

// The update formulas of the march: the distance at a vertex w of a cell from those at its other
// corners. All of them compute in the plane of the triangle, or in the space of the tetrahedron,
// with scalar products of edges from one of the known corners, so that a surface in space needs no
// coordinates of its own. The cost is a few square roots per update. Distances are double
// precision: the virtual source of a long front is a small difference of large squares.

/**
 * A front that arrives at a vertex w through a cell whose other corners it has passed, by the
 * shortest of all paths to w that cross the facet of these corners (the Hopf-Lax formula; Kimmel
 * and Sethian 1998 for a front that is straight within the cell). The front of a point is round:
 * its *virtual source* is the point at the known distances from the corners, in the plane of the
 * triangle (Novotni and Klein 2002; Reimers 2004), or in space for a tetrahedron, and w has the
 * distance from there.
 */
struct Arrival
{
  /** Whether no path crosses the inside of the facet. */
  bool isNone() const { return this->distance == std::numeric_limits<double>::infinity(); }
  /** The corner of the facet, 0 to 2, that has the largest weight where the path crosses it. */
  int nearestCorner() const
  {
    const double rest = 1 - this->weight[0] - this->weight[1];
    return rest >= std::max(this->weight[0], this->weight[1]) ? 0
           : this->weight[0] >= this->weight[1]               ? 1
                                                              : 2;
  }

  double distance = std::numeric_limits<double>::infinity();
  bool isStraight = false; ///< whether the front is straight at w: see FrontCorner
  /** The barycentric weights of corners 1 and 2 of the facet, at the point where the path crosses
   * it. */
  double weight[2] = { 0, 0 };
};

/** A corner that the front has passed. The front of a point is *round*, with the distance as its
 * radius; the front of a curve or a surface is *straight*. */
struct FrontCorner
{
  const double* point;
  double distance;
  bool isStraight;
  std::int64_t source = 0; ///< corners of one facet show one source only if this is the same
};

/** The path from a corner along the edge to w. */
inline Arrival fromCorner(const FrontCorner& a, double length)
{
  // At a source (distance 0), the path is taken for one from the end of a curve, beyond which the
  // front is round.
  return { a.distance + length, a.isStraight && a.distance > 0 };
}

/** A straight front may also cross a facet at its ends, up to rounding: there the front of a curve
 * goes straight on. Relative to the size of the facet. */
inline constexpr double StraightMargin = 1e-9;

/** Scalar products of the edge e from corner a to corner b, and of w - a (here w). */
struct EdgeFrame
{
  double ee, ew, ww;
};

/** The radius at w of a front with the radii `ra` and `rb` at the corners of an edge. Infinite if
 * the straight line from the virtual source to w does not cross the inside of the edge; otherwise
 * `along` is set to the weight of b at the crossing. The source and w lie on different sides of the
 * edge. */
inline double roundAcrossEdge(const EdgeFrame& f, double ra, double rb, double& along)
{
  const double share = 1 / f.ee;
  // s . e, with s from a to the virtual source: from |s| = ra and |s - e| = rb. The factors cancel
  // less than the difference of squares.
  const double se = 0.5 * ((ra - rb) * (ra + rb) + f.ee);
  // The squared distance of the source from the line of the edge. Rounding may make it negative for
  // a source on that line.
  const double depth2 = ra * ra - se * se * share;
  constexpr double Tiny = 1e-9;
  if (depth2 >= -Tiny * f.ee)
  {
    const double depth = std::sqrt(std::max(depth2, 0.0));
    const double height = std::sqrt(std::max(f.ww - f.ew * f.ew * share, 0.0));
    const double crossing = se * height + f.ew * depth, whole = f.ee * (depth + height);
    if (crossing > 0 && crossing < whole)
    {
      along = crossing / whole;
      return std::sqrt(std::max(f.ww + ra * ra + 2 * (height * depth - f.ew * se * share), 0.0));
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** The same for a straight front with the distances `da` and `db`: returns the distance at w. The
 * gradient has length 1, the component `slope` along the edge and `steep` across it. */
inline double straightAcrossEdge(const EdgeFrame& f, double da, double db, double& along)
{
  const double length = std::sqrt(f.ee);
  const double slope = (db - da) / length;
  const double steep2 = 1 - slope * slope;
  if (steep2 > 0)
  {
    const double steep = std::sqrt(steep2);
    const double foot = f.ew / length;
    const double height = std::sqrt(std::max(f.ww - foot * foot, 0.0));
    const double crossing = foot - height * slope / steep;
    if (crossing > -StraightMargin * length && crossing < (1 + StraightMargin) * length)
    {
      along = crossing / length;
      return da + slope * foot + steep * height;
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** Scalar products of the edges e and f of a face, from corner a to b and c, and of w - a (here w).
 */
struct FaceFrame
{
  double ee, ef, ff, ew, fw, ww;

  /** 1 over the square of twice the area of the face. */
  double share() const { return 1 / (this->ee * this->ff - this->ef * this->ef); }
};

/** A vector in the plane of a face, x e + y f, determined by its products with e and f. */
struct InFace
{
  InFace(const FaceFrame& frame, double share, double byE, double byF)
    : x((frame.ff * byE - frame.ef * byF) * share)
    , y((frame.ee * byF - frame.ef * byE) * share)
  {
  }
  /** Whether the point at this vector from a, divided by `whole`, lies inside the face. */
  bool isInside(double whole, double margin = 0) const
  {
    const double least = -margin * whole;
    return this->x > least && this->y > least && this->x + this->y < whole - least;
  }

  double x, y;
};

/** As roundAcrossEdge(), for the corners of a face; `along` gets the weights of b and c. */
inline double roundAcrossFace(
  const FaceFrame& f, double ra, double rb, double rc, double (&along)[2])
{
  const double share = f.share();
  const double se = 0.5 * ((ra - rb) * (ra + rb) + f.ee);
  const double sf = 0.5 * ((ra - rc) * (ra + rc) + f.ff);
  const InFace s(f, share, se, sf), w(f, share, f.ew, f.fw);
  const double depth2 = ra * ra - (s.x * se + s.y * sf);
  if (depth2 >= 0)
  {
    const double depth = std::sqrt(depth2);
    const double height = std::sqrt(std::max(f.ww - (w.x * f.ew + w.y * f.fw), 0.0));
    InFace crossing = s;
    crossing.x = s.x * height + w.x * depth;
    crossing.y = s.y * height + w.y * depth;
    if (crossing.isInside(depth + height))
    {
      along[0] = crossing.x / (depth + height);
      along[1] = crossing.y / (depth + height);
      return std::sqrt(
        std::max(f.ww + ra * ra + 2 * (height * depth - (w.x * se + w.y * sf)), 0.0));
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** As straightAcrossEdge(), for the corners of a face. */
inline double straightAcrossFace(
  const FaceFrame& f, double da, double db, double dc, double (&along)[2])
{
  const double share = f.share();
  const double ge = db - da, gf = dc - da; // products of the gradient g in the face with e and f
  const InFace g(f, share, ge, gf), w(f, share, f.ew, f.fw);
  const double steep2 = 1 - (g.x * ge + g.y * gf);
  if (steep2 > 0)
  {
    const double steep = std::sqrt(steep2);
    const double height = std::sqrt(std::max(f.ww - (w.x * f.ew + w.y * f.fw), 0.0));
    InFace crossing = w;
    crossing.x -= height / steep * g.x;
    crossing.y -= height / steep * g.y;
    if (crossing.isInside(1, StraightMargin))
    {
      along[0] = crossing.x;
      along[1] = crossing.y;
      return da + g.x * f.ew + g.y * f.fw + steep * height;
    }
  }
  return std::numeric_limits<double>::infinity();
}

/** The path to w that crosses the inside of the edge from a to b; `f` is its frame. If one corner
 * has a straight front and the other a round one, the front is that of the corner nearest to the
 * path, so that the border between the two does not drift. */
inline Arrival acrossEdge(const EdgeFrame& f, const FrontCorner& a, const FrontCorner& b)
{
  Arrival arrival;
  if (a.isStraight || b.isStraight)
  {
    arrival.distance = straightAcrossEdge(f, a.distance, b.distance, arrival.weight[0]);
    arrival.isStraight = (arrival.nearestCorner() == 0 ? a : b).isStraight;
    if (arrival.isStraight || arrival.isNone())
    {
      return arrival;
    }
  }
  arrival.distance = roundAcrossEdge(f, a.distance, b.distance, arrival.weight[0]);
  return arrival;
}

/** As acrossEdge(), for a face. */
inline Arrival acrossFace(
  const FaceFrame& f, const FrontCorner& a, const FrontCorner& b, const FrontCorner& c)
{
  Arrival arrival;
  if (a.isStraight || b.isStraight || c.isStraight)
  {
    arrival.distance = straightAcrossFace(f, a.distance, b.distance, c.distance, arrival.weight);
    const int nearest = arrival.nearestCorner();
    arrival.isStraight = (nearest == 0 ? a : nearest == 1 ? b : c).isStraight;
    if (arrival.isStraight || arrival.isNone())
    {
      return arrival;
    }
  }
  arrival.distance = roundAcrossFace(f, a.distance, b.distance, c.distance, arrival.weight);
  return arrival;
}

} // namespace smg
