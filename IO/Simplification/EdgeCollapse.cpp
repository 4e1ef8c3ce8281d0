// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/EdgeCollapse.h"

#include "IO/Simplification/LoopCuts.h"
#include "IO/Simplification/SeamVertices.h"
#include "Solver/Core/Vector.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

// Edge collapse by quadric error metrics (Garland and Heckbert 1997) in passes instead of by a
// priority queue.
//
// A pass ranks all edges, sorts them by a counting sort, and collapses in that order those whose
// ends are untouched in the pass; neighbours of a collapse wait for the next one. A pass ends early
// when the edges get much worse than necessary, so that the order of the collapses is nearly that
// of a queue. About ten passes leave an eighth of the vertices, each linear in the triangles.
//
// Vertices only move onto others, so each that is left is a vertex of the mesh where it was. The
// quadric of a vertex is the sum of the quadrics of all vertices that it stands for. All decisions
// are taken in the order of the edges, so the result is unique.

namespace smg
{
namespace
{

/** The share of the squared length that is added to the squared error: of edges with equal errors,
 * as in flat regions, the shortest goes first. */
constexpr double LengthShare = 1e-3;
/** The weight of the plane that holds a boundary edge, compared with triangles of its length. */
constexpr double BoundaryWeight = 10.0;
/** A vertex of the boundary may be so many squared errors from the edge that replaces it: planes do
 * not see how long a spike is that is narrower than the error. */
constexpr double Spike = 9.0;
/** A pass in which less than this share of the vertices goes ends a rough simplification; one in
 * which less than this share of what is still to go does is slow. */
constexpr std::size_t RoughShare = 20, SlowShare = 32;

/** A possible collapse of the vertex `from` onto `to`. */
struct Collapse
{
  std::uint32_t from, to;
  float rank; ///< squared error, and a little for the length, in units of the part
};

/** The largest distance along an axis from the first vertex. */
double extentOf(const SurfacePart& part)
{
  double extent = 0.0;
  for (std::size_t i = 0; i < part.points.size(); ++i)
  {
    extent = std::max(extent, std::fabs(part.points[i] - part.points[i % 3]));
  }
  return extent;
}

/** The vertices at places of joined seams where three sides or more meet. */
std::size_t cornersOfSeams(const SurfacePart& part)
{
  constexpr std::uint8_t Sides = 3;
  std::size_t corners = 0;
  for (const std::uint8_t number : part.atPlace)
  {
    corners += number >= Sides ? number : 0;
  }
  return corners;
}

class Collapser
{
public:
  Collapser(SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll)
    : Part(part)
    , Surface(part, open, poll)
    , Polled(poll)
  {
    // Ranks are relative to the extent of the part, so that they neither overflow nor vanish in
    // single precision.
    const double extent = extentOf(part);
    this->InverseSquare = extent > 0.0 ? 1.0 / extent / extent : 1.0;
  }

  /** Computes the quadrics of the vertices from the planes of their triangles, weighted by
   * areas. */
  void addPlanes()
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    this->Part.quadrics.clear();
    this->Polled.resize(this->Part.quadrics, this->Part.vertices());
    this->Part.lacksBoundary.assign(this->Part.vertices(), 1);
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
      this->Polled.at(i);
      const std::uint32_t* c = corners.data() + i;
      const Vector area = this->Part.area(c[0], c[1], c[2]);
      this->addPlane({ c, 3 }, area, std::sqrt(dot(area, area)));
    }
  }

  /** Adds for each boundary edge, and for each edge between labels or on a seam, the plane through
   * it that is perpendicular to its triangle, which holds the curve where it is. Each edge gets it
   * once: as soon as all triangles of one of its ends are in the part. */
  void addBoundary()
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    std::vector<std::uint8_t>& lacks = this->Part.lacksBoundary;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      this->Polled.at(i);
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1, last = i % 3 == 0 ? i + 2 : i - 1;
      const std::uint32_t ends[2] = { corners[i], corners[next] };
      // If either end has had its boundary edges before, this edge was among them.
      if (lacks[ends[0]] && lacks[ends[1]] &&
          (this->Surface.isBoundary(ends[0], ends[1]) || this->Surface.isBorder(ends[0], ends[1])))
      {
        const Vector edge = difference(this->Part.point(ends[1]), this->Part.point(ends[0]));
        const Vector area =
          cross(edge, difference(this->Part.point(corners[last]), this->Part.point(ends[0])));
        this->addPlane(ends, cross(edge, area), BoundaryWeight * dot(edge, edge));
      }
    }
    for (std::uint32_t v = 0; v < lacks.size(); ++v)
    {
      this->Polled.at(v);
      // Open vertices may have further boundary edges in later parts.
      lacks[v] = lacks[v] != 0 && this->Surface.isOpen(v) ? 1 : 0;
    }
  }

  /** Passes until the goal is reached or nothing can collapse. Where the topology may change and
   * nothing else is possible, borders between labels are given up, then the sides of seams, and
   * then triangles may turn. */
  Collapsed run(const CollapseGoal& goal)
  {
    if (goal.mayCut && goal.vertices < this->Part.vertices())
    {
      this->Cuts.emplace(this->Part, this->Surface, this->InverseSquare);
    }
    this->Limit = goal.error * goal.error;
    Collapsed done;
    double error = 0.0; // squared
    std::size_t left = this->Part.wedges.empty() ? this->Part.vertices() : this->usedVertices();
    while (left > goal.vertices)
    {
      this->Polled.now();
      this->rankEdges(goal.error * goal.error);
      const LoopCuts::Pass pass = this->collapse(left - goal.vertices, left);
      this->Surface.endPass();
      // Where seams are given up, more than these are gone.
      left = this->Part.wedges.empty() ? left - pass.gone + pass.came : this->usedVertices();
      done.bodies += pass.bodies;
      error = std::max(error, pass.error);
      const bool isEnough = goal.isRough && pass.gone < pass.came + left / RoughShare;
      if (left <= goal.vertices || isEnough)
      {
        break;
      }
      const bool isSlow = pass.gone <= pass.came + (left - goal.vertices) / SlowShare;
      const bool isNone = pass.gone + pass.came == 0;
      const bool isAll = isNone && !pass.hasMore();
      if (isAll && this->Cuts && this->Surface.keepsBorders())
      {
        this->Surface.releaseBorders();
        done.crossesBorders = this->Part.hasBorders();
      }
      else if (const std::size_t welded =
                 isAll && this->Cuts ? weldSeams(this->Part, left - goal.vertices, this->Polled)
                                     : 0;
               welded > 0)
      {
        done.welded += welded;
        left = this->usedVertices();
      }
      else if (isAll && this->Cuts && !this->Surface.mayTurn())
      {
        this->Surface.letTurn();
        done.turns = true;
      }
      else if (isAll)
      {
        break;
      }
      if (this->Cuts && isSlow)
      {
        this->Reached = pass.nextLimit(this->Reached);
      }
    }
    separateSeams(this->Part);
    this->Part.dropUnusedVertices(this->Polled);
    done.error = std::sqrt(error);
    return done;
  }

private:
  /** The vertices that triangles have, of those that are joined at seams each. */
  std::size_t usedVertices() const
  {
    std::vector<std::uint8_t> isUsed(this->Part.vertices(), 0);
    for (std::size_t i = 0; i < this->Part.wedges.size(); ++i)
    {
      this->Polled.at(i);
      isUsed[this->Part.wedges[i]] = 1;
    }
    return static_cast<std::size_t>(std::ranges::count(isUsed, 1));
  }

  /** Adds the plane with this normal, of any length, through the first of some vertices that lie in
   * it, to all of them. */
  void addPlane(std::span<const std::uint32_t> to, const Vector& normal, double weight)
  {
    const double length = std::sqrt(dot(normal, normal));
    // A triangle without area has no plane.
    if (!(length > 0.0))
    {
      return;
    }
    const Vector unit{ normal[0] / length, normal[1] / length, normal[2] / length };
    // Relative to a point of the mesh: far from the origin of the coordinates, squares would lose
    // their digits.
    const Vector at = difference(this->Part.point(to[0]), this->Part.origin.data());
    Quadric plane;
    plane.addPlane(unit.data(), at.data(), weight);
    for (const std::uint32_t v : to)
    {
      this->Part.quadrics[v].add(plane);
    }
  }

  /** The squared error of a collapse: what `from` stands for, measured at the place of `to`. */
  double errorOf(std::uint32_t from, std::uint32_t to) const
  {
    const Vector at = difference(this->Part.point(to), this->Part.origin.data());
    return this->Part.quadrics[from].squaredDistance(at.data());
  }

  /** Lists the edges one of whose ends may go with at most this squared error. */
  void rankEdges(double limit)
  {
    const std::vector<std::uint32_t>& corners = this->Part.corners;
    this->Edges.clear();
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      this->Polled.at(i);
      const std::uint32_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
      // An edge of two triangles is listed by that which runs along it upwards; the other one runs
      // along it in the other direction. At the boundary, or where triangles are wound against each
      // other, every triangle lists it: a second entry does no harm.
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
      const Vector edge = difference(this->Part.point(a), this->Part.point(b));
      const auto rank =
        static_cast<float>((error + LengthShare * dot(edge, edge)) * this->InverseSquare);
      this->Edges.push_back(ofA <= ofB ? Collapse{ a, b, rank } : Collapse{ b, a, rank });
    }
  }

  /** Sorts the edges by ascending rank, and edges of nearly the same rank by their numbers: a
   * counting sort by the leading bits of the rank. The bits of a positive float have the order of
   * its value. */
  void sortEdges()
  {
    constexpr int Dropped = 15; // bits of the number: 8 of the mantissa count
    const auto keyOf = [](const Collapse& edge)
    { return std::bit_cast<std::uint32_t>(edge.rank) >> Dropped; };
    this->Begin.assign((1U << (32 - Dropped)) + 1, 0);
    for (std::size_t e = 0; e < this->Edges.size(); ++e)
    {
      this->Polled.at(e);
      ++this->Begin[keyOf(this->Edges[e]) + 1];
    }
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    this->Order.resize(this->Edges.size());
    for (std::uint32_t e = 0; e < this->Edges.size(); ++e)
    {
      this->Polled.at(e);
      this->Order[this->Begin[keyOf(this->Edges[e])]++] = e;
    }
  }

  /** Collapses edges until at most about `most` vertices have gone. */
  LoopCuts::Pass collapse(std::size_t most, std::size_t vertices)
  {
    this->sortEdges();
    // Neighbours of a collapse wait for the next pass, and some edges may not collapse, about as
    // many as in the last one. So this one goes on to edges that are somewhat worse than those that
    // would suffice without such neighbours, but not much worse. It collapses at least a thirtieth
    // of the vertices if it can, since a pass costs the same for fewer.
    constexpr float Worse = 1.5F;
    const std::size_t least = std::max(most / 6, vertices / 30);
    const std::size_t enough = std::min(most + this->Blocked, this->Edges.size() * 3 / 4);
    const float usual = this->Order.empty() ? 0.0F : this->Edges[this->Order[enough]].rank;
    this->Blocked = 0;
    LoopCuts::Pass pass;
    pass.most = most;
    for (std::size_t k = 0; k < this->Order.size() && pass.gone < most; ++k)
    {
      this->Polled.at(k);
      const auto [from, to, rank] = this->Edges[this->Order[k]];
      if (k > enough && pass.gone > least && rank > Worse * usual)
      {
        break;
      }
      // The triangles of both must be those that were ranked.
      if (this->Surface.areUntouched(from, to) && !this->change(from, to, rank, pass))
      {
        ++this->Blocked;
      }
    }
    return pass;
  }

  /** Collapses an edge, or changes the topology there. Returns whether it has done so. */
  bool change(std::uint32_t from, std::uint32_t to, float rank, LoopCuts::Pass& pass)
  {
    using Change = SurfaceTopology::Change;
    const Change topology = this->Surface.changeBy(from, to);
    if (topology == Change::Impossible || (topology != Change::None && !this->Cuts))
    {
      return false;
    }
    if (topology == Change::Vanishing)
    {
      return this->Cuts->removeBody(from, to, this->Reached, pass);
    }
    if (topology == Change::Sheet && !this->Cuts->mayRemoveSheet(from, to, this->Reached, pass))
    {
      return false;
    }
    bool isHole = false;
    if (topology == Change::Loop)
    {
      const LoopCuts::Done done = this->Cuts->cut(from, to, rank, this->Reached, pass);
      isHole = done == LoopCuts::Done::Hole;
      if (!isHole)
      {
        return done == LoopCuts::Done::Cut;
      }
    }
    if (this->Surface.turn(this->Surface.star(from), from, to) ||
        this->Surface.fromBoundary(from, to) > Spike * this->Limit)
    {
      return false;
    }
    this->Reached = std::max(this->Reached, rank);
    pass.error = std::max(pass.error, this->errorOf(from, to));
    this->Part.quadrics[to].add(this->Part.quadrics[from]);
    this->Surface.move(from, to);
    if (this->Cuts)
    {
      this->Cuts->addGone(from, to);
    }
    if (isHole)
    {
      this->Cuts->closeHole(to);
    }
    pass.gone += this->Part.joinedIn(from);
    return true;
  }

  SurfacePart& Part;
  SurfaceTopology Surface;
  const Poll& Polled;
  std::optional<LoopCuts> Cuts; ///< where the topology may change
  std::size_t Blocked =
    0;                  ///< edges of the last pass that it has come to, and that did not collapse
  float Reached = 0.0F; ///< the largest rank of a collapse, or what cuts may cost
  double Limit = std::numeric_limits<double>::infinity(); ///< of the squared error
  double InverseSquare = 1.0; ///< of the extent of the part, so that ranks are in single precision
  std::vector<Collapse> Edges;
  std::vector<std::uint32_t> Order, Begin;
};

} // namespace

Collapsed collapseEdges(
  SurfacePart& part, std::span<const std::uint8_t> open, const CollapseGoal& goal, const Poll& poll)
{
  const bool needsPlanes = part.quadrics.empty();
  if (part.triangles() == 0)
  {
    return {};
  }
  joinSeams(part, open, poll);
  // Where three sides of seams meet no edge can collapse: such places must not be what is left.
  constexpr std::size_t ShareOfCorners = 4;
  const bool isTight = goal.mayCut && goal.vertices < part.vertices() &&
                       ShareOfCorners * cornersOfSeams(part) > goal.vertices;
  const std::size_t welded = isTight ? weldSeams(part, part.vertices() - goal.vertices, poll) : 0;
  Collapser collapser(part, open, poll);
  if (needsPlanes)
  {
    collapser.addPlanes();
  }
  // Also for parts that have quadrics: edges whose ends were open before may be complete by this
  // time.
  collapser.addBoundary();
  Collapsed done = collapser.run(goal);
  done.welded += welded;
  return done;
}

Collapsed collapseFlat(
  SurfacePart& part, std::span<const std::uint8_t> open, std::size_t vertices, const Poll& poll)
{
  constexpr double Rounding = 1e-6;
  return collapseEdges(
    part, open, { .vertices = vertices, .error = Rounding * extentOf(part) }, poll);
}

} // namespace smg
