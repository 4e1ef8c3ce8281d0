// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/EdgeCollapse.h"

#include "IO/Simplification/SurfaceTopology.h"
#include "Solver/Core/Vector.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

namespace smg
{
namespace
{

/** Of edges of equal errors, this share of the squared length decides. */
constexpr double LengthShare = 1e-3;
/** The weight of a boundary edge compared with triangles of its length. */
constexpr double BoundaryWeight = 10.0;
/** Where the topology may change, it does for an error that is four times smaller than others. */
constexpr float PinchWorth = 16.0F;
/** The least cosine of the angle by which a triangle may turn. */
constexpr double MinCosine = 0.2;

/** A collapse of `from` onto `to`. */
struct Collapse
{
  std::uint32_t from, to;
  float rank; ///< squared error, and a little for the length, in units of the part
};

class Collapser
{
public:
  Collapser(SurfacePart& part, std::span<const std::uint8_t> open)
    : Part(part)
    , Surface(part.corners, open)
  {
    double extent = 0.0;
    for (std::size_t i = 0; i < part.points.size(); ++i)
    {
      extent = std::max(extent, std::fabs(part.points[i] - part.points[i % 3]));
    }
    this->InverseSquare = extent > 0.0 ? 1.0 / extent / extent : 1.0;
  }

  /** Makes the quadrics of the triangles. */
  void addPlanes()
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    this->Part.quadrics.assign(this->Part.vertices(), {});
    this->Part.lacksBoundary.assign(this->Part.vertices(), 1);
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
      const std::uint32_t* c = corners.data() + i;
      const Vector area = cross(difference(this->point(c[1]), this->point(c[0])),
        difference(this->point(c[2]), this->point(c[0])));
      this->addPlane({ c, 3 }, area, std::sqrt(dot(area, area)));
    }
  }

  /** Adds to boundary edges the planes that hold them, of each edge once: as soon as one of its
   * ends has all its triangles here. */
  void addBoundary()
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    std::vector<std::uint8_t>& lacks = this->Part.lacksBoundary;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1, last = i % 3 == 0 ? i + 2 : i - 1;
      const std::uint32_t ends[2] = { corners[i], corners[next] };
      if (lacks[ends[0]] && lacks[ends[1]] && this->Surface.isBoundary(ends[0], ends[1]))
      {
        const Vector edge = difference(this->point(ends[1]), this->point(ends[0]));
        const Vector area =
          cross(edge, difference(this->point(corners[last]), this->point(ends[0])));
        this->addPlane(ends, cross(edge, area), BoundaryWeight * dot(edge, edge));
      }
    }
    for (std::uint32_t v = 0; v < lacks.size(); ++v)
    {
      lacks[v] = lacks[v] != 0 && this->Surface.isOpen(v) ? 1 : 0;
    }
  }

  double run(const CollapseGoal& goal)
  {
    this->MayPinch = goal.mayPinch && goal.vertices < this->Part.vertices();
    if (this->MayPinch)
    {
      this->Surface.allowPinching();
    }
    float worth = PinchWorth;
    for (std::size_t left = this->Part.vertices(); left > goal.vertices;)
    {
      this->rankEdges(goal.error * goal.error);
      this->Pinched = 0;
      const std::size_t gone = this->collapse(left - goal.vertices, left, worth);
      left -= gone;
      this->Surface.endPass();
      if (this->Pinched > 0)
      {
        left = this->Surface.dropFolded();
      }
      if (gone == 0)
      {
        if (!this->MayPinch || worth == 0.0F)
        {
          break;
        }
        worth = 0.0F; // no other collapse is possible
      }
    }
    this->Part.dropUnusedVertices();
    return std::sqrt(this->Error);
  }

private:
  const double* point(std::uint32_t v) const
  {
    return this->Part.points.data() + 3 * std::size_t(v);
  }

  /** Adds the plane of this normal, of any length, to some vertices in it. */
  void addPlane(std::span<const std::uint32_t> to, const Vector& normal, double weight)
  {
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0.0))
    {
      return;
    }
    const Vector unit{ normal[0] / length, normal[1] / length, normal[2] / length };
    const Vector at = difference(this->point(to[0]), this->Part.origin.data());
    Quadric plane;
    plane.addPlane(unit.data(), at.data(), weight);
    for (const std::uint32_t v : to)
    {
      this->Part.quadrics[v].add(plane);
    }
  }

  /** The squared error of a collapse. */
  double errorOf(std::uint32_t from, std::uint32_t to) const
  {
    const Vector at = difference(this->point(to), this->Part.origin.data());
    return this->Part.quadrics[from].squaredDistance(at.data());
  }

  /** Lists the edges with an end that may go within a squared error. */
  void rankEdges(double limit)
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    this->Edges.clear();
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const std::uint32_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
      // The second triangle of an edge runs along it in the other direction. Where it does not,
      // both list the edge.
      if (a < b || this->Surface.mayBeBoundary(a, b) || this->Surface.isTurned())
      {
        this->rank(a, b, limit);
      }
    }
  }

  void rank(std::uint32_t a, std::uint32_t b, double limit)
  {
    constexpr double None = std::numeric_limits<double>::infinity();
    const double ofA = this->Surface.mayGo(a) ? this->errorOf(a, b) : None;
    const double ofB = this->Surface.mayGo(b) ? this->errorOf(b, a) : None;
    const double error = std::min(ofA, ofB);
    if (error <= limit && error < None)
    {
      const Vector edge = difference(this->point(a), this->point(b));
      const auto rank =
        static_cast<float>((error + LengthShare * dot(edge, edge)) * this->InverseSquare);
      this->Edges.push_back(ofA <= ofB ? Collapse{ a, b, rank } : Collapse{ b, a, rank });
    }
  }

  /** The edges by ascending rank, those of about the same in their order. */
  void sortEdges()
  {
    constexpr int Dropped = 15; // bits of the number: 8 of the mantissa count
    const auto keyOf = [](const Collapse& edge)
    { return std::bit_cast<std::uint32_t>(edge.rank) >> Dropped; };
    this->Begin.assign((1U << (32 - Dropped)) + 1, 0);
    for (const Collapse& edge : this->Edges)
    {
      ++this->Begin[keyOf(edge) + 1];
    }
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    this->Order.resize(this->Edges.size());
    for (std::uint32_t e = 0; e < this->Edges.size(); ++e)
    {
      this->Order[this->Begin[keyOf(this->Edges[e])]++] = e;
    }
  }

  /** Collapses edges of so many vertices, at most `most`; returns their number. Those that change
   * the topology must have a rank `worth` times smaller than the others. */
  std::size_t collapse(std::size_t most, std::size_t vertices, float worth)
  {
    this->sortEdges();
    // Neighbours of a collapse wait for the next pass: this one ends before edges that are much
    // worse than those that would suffice without such neighbours; but not before a thirtieth of
    // the vertices, for which a pass over all would not pay.
    constexpr float Worse = 1.5F;
    const std::size_t least = std::max(most / 6, vertices / 30);
    const std::size_t enough = std::min(most, this->Edges.size() / 2);
    const float usual = this->Order.empty() ? 0.0F : this->Edges[this->Order[enough]].rank;
    std::size_t done = 0;
    for (std::size_t k = 0; k < this->Order.size() && done < most; ++k)
    {
      const auto [from, to, rank] = this->Edges[this->Order[k]];
      if (k > enough && done > least && rank > Worse * usual)
      {
        break;
      }
      if (!this->Surface.areUntouched(from, to))
      {
        continue;
      }
      const SurfaceTopology::Change change = this->Surface.changeBy(from, to);
      const bool pinches = change == SurfaceTopology::Change::Pinch;
      const bool isAllowed =
        pinches ? this->MayPinch && worth * rank <= usual : change == SurfaceTopology::Change::None;
      if (isAllowed && !this->turnsOver(from, to))
      {
        this->Error = std::max(this->Error, this->errorOf(from, to));
        this->Part.quadrics[to].add(this->Part.quadrics[from]);
        this->Surface.move(from, to);
        this->Pinched += pinches ? 1 : 0;
        ++done;
      }
    }
    return done;
  }

  /** Whether a triangle of `from` turns by too much when that vertex goes. */
  bool turnsOver(std::uint32_t from, std::uint32_t to) const
  {
    return std::ranges::any_of(this->Surface.star(from),
      [&](std::uint32_t triangle)
      {
        const auto [a, b] = this->Surface.others(triangle, from);
        if (a == b || a == to || b == to)
        {
          return false;
        }
        const Vector edge = difference(this->point(b), this->point(a));
        const Vector before = cross(edge, difference(this->point(from), this->point(a)));
        const Vector after = cross(edge, difference(this->point(to), this->point(a)));
        const double product = dot(before, after), size = dot(before, before);
        return size > 0.0 && !(product > 0.0 && product * product >
                                                  MinCosine * MinCosine * size * dot(after, after));
      });
  }

  SurfacePart& Part;
  SurfaceTopology Surface;
  bool MayPinch = false;
  std::size_t Pinched = 0;    ///< collapses of this pass that changed the topology
  double InverseSquare = 1.0; ///< of the extent of the part, so that ranks are in single precision
  double Error = 0.0;         ///< squared
  std::vector<Collapse> Edges;
  std::vector<std::uint32_t> Order, Begin;
};

} // namespace

double collapseEdges(
  SurfacePart& part, std::span<const std::uint8_t> open, const CollapseGoal& goal)
{
  const bool needsPlanes = part.quadrics.empty();
  if (part.triangles() == 0)
  {
    return 0.0;
  }
  Collapser collapser(part, open);
  if (needsPlanes)
  {
    collapser.addPlanes();
  }
  collapser.addBoundary();
  return collapser.run(goal);
}

} // namespace smg
