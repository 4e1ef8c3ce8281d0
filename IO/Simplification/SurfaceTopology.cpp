// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/SurfaceTopology.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <numeric>
#include <utility>

// Which edges of a surface may collapse without a change of its topology: the link condition (Dey,
// Edelsbrunner, Guha and Nekhayev 1999), tested on the triangles around both ends.
//
// In a pass no vertex goes that another one has come to, nor the other way round. So the triangles
// of a vertex are those listed at the beginning of the pass, with corners where they have gone
// since (Target), and lists are made once in a pass. Vertices are marked with numbers that only
// grow, so marks are never cleared. Testing an edge takes time linear in the triangles of its ends,
// of which there are at most MaxTriangles each.

namespace smg
{

namespace
{

/** A vertex of more triangles does not go, and no other one goes to it: such stars would be
 * searched for each of their edges. */
constexpr std::size_t MaxTriangles = 512;
/** The least cosine of the angle by which a triangle may turn. */
constexpr double MinCosine = 0.2;

} // namespace

SurfaceTopology::SurfaceTopology(
  SurfacePart& part, std::span<const std::uint8_t> open, const Poll& poll)
  : Part(part)
  , Corners(part.corners)
  , Open(open)
  , Polled(poll)
  , IsFixed(open.size())
  , Curves(open.size())
  , KeepsBorders(part.hasBorders() || !part.wedges.empty())
  , Target(open.size())
  , Touched(open.size())
  , Seen(open.size(), 0)
  , Common(open.size(), 0)
{
  this->findStars();
  for (std::uint32_t v = 0; v < open.size(); ++v)
  {
    poll.at(v);
    this->classify(v);
  }
}

/** Lists the triangles of each vertex, by a counting sort. */
void SurfaceTopology::findStars()
{
  this->Begin.assign(this->vertices() + 2, 0);
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    this->Polled.at(i);
    ++this->Begin[this->Corners[i] + 2];
  }
  std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
  this->Polled.resize(this->Stars, this->Corners.size());
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    this->Polled.at(i);
    // The begins are shifted by one place, so that counting them up makes each the beginning of the
    // next vertex.
    this->Stars[this->Begin[this->Corners[i] + 1]++] = static_cast<std::uint32_t>(i / 3);
  }
  std::iota(this->Target.begin(), this->Target.end(), 0U);
  std::ranges::fill(this->Touched, 0);
}

/** Finds whether v may go, and whether it is on the boundary. */
void SurfaceTopology::classify(std::uint32_t v)
{
  this->Pairs.clear();
  for (const std::uint32_t t : this->star(v))
  {
    this->Pairs.push_back(this->others(t, v));
  }
  // Each neighbour has two triangles, or one at an end of the fan. In a fan that is wound alike a
  // neighbour comes first in at most one of its triangles and last in at most one.
  std::size_t neighbours = 0;
  const std::uint32_t known = ++this->Mark;
  for (const std::size_t place : { 0, 1 })
  {
    ++this->Mark;
    for (const auto& pair : this->Pairs)
    {
      const std::uint32_t w = pair[place];
      neighbours += this->Seen[w] != known ? 1 : 0;
      this->Seen[w] = known;
      this->IsTurned = this->IsTurned || this->Common[w] == this->Mark;
      this->Common[w] = this->Mark;
    }
  }
  const std::size_t triangles = this->Pairs.size();
  // To look at all triangles of such a vertex for each of its edges would take the square of their
  // number.
  const bool isHub = triangles > MaxTriangles;
  const bool isOneFan = !isHub && neighbours <= triangles + 1 && this->isFan();
  this->IsFixed[v] = this->Open[v] != 0 || !isOneFan ? ByTopology : 0;
  // A closed fan has as many neighbours as triangles; several fans may have as many, too.
  this->Curves[v] = neighbours != triangles || (!isHub && !isOneFan) ? OnBoundary : 0;
  if (this->Part.isHeld(v) || (this->Part.seamOf(v) > 0 && this->Part.joinedIn(v) == 1))
  {
    this->IsFixed[v] |= ByHold;
  }
  if (this->KeepsBorders)
  {
    const std::size_t curves = this->curvesAt(v);
    this->Curves[v] |= curves > 0 ? OnBorder : 0;
    this->IsFixed[v] |= curves > 0 && curves != 2 ? ByBorders : 0;
  }
}

/** Whether two triangles at an edge have the same labels, there is no seam between them, and the
 * edge is in no group. */
bool SurfaceTopology::areAlike(
  std::size_t one, std::size_t other, std::uint32_t v, std::uint32_t w) const
{
  return this->Part.haveSameLabels(one, other) && this->edgeSet(one, v, w) == 0 &&
         this->edgeSet(other, v, w) == 0 &&
         (this->Part.wedges.empty() || (this->wedgeAt(one, v) == this->wedgeAt(other, v) &&
                                         this->wedgeAt(one, w) == this->wedgeAt(other, w)));
}

/** Whether triangles have the same labels, no edges in groups, and no corners on seams but those
 * that stand for all. */
bool SurfaceTopology::isUniform(std::span<const std::uint32_t> star) const
{
  return std::ranges::all_of(star,
    [&](std::size_t t)
    {
      return this->Part.haveSameLabels(star[0], t) && !this->Part.hasEdgeSets(t) &&
             (this->Part.wedges.empty() ||
               std::equal(this->Corners.begin() + 3 * static_cast<std::ptrdiff_t>(t),
                 this->Corners.begin() + 3 * static_cast<std::ptrdiff_t>(t + 1),
                 this->Part.wedges.begin() + 3 * static_cast<std::ptrdiff_t>(t)));
    });
}

/** The vertex, of those that are joined in v, that a triangle has. */
std::uint32_t& SurfaceTopology::wedgeAt(std::size_t triangle, std::uint32_t v) const
{
  const std::uint32_t* c = this->Corners.data() + 3 * triangle;
  const std::size_t k = this->Target[c[0]] == v ? 0 : this->Target[c[1]] == v ? 1 : 2;
  return this->Part.wedges[3 * triangle + k];
}

/** Finds onto which vertex each of those that are joined in `from` moves: that at `to` on its side
 * of the edge between them. Returns whether there is one for each, and not two. */
bool SurfaceTopology::findMoves(std::uint32_t from, std::uint32_t to)
{
  this->Pairs.clear();
  for (const std::uint32_t t : this->star(from))
  {
    const auto [a, b] = this->others(t, from);
    if (a != b && (a == to || b == to))
    {
      this->Pairs.push_back({ this->wedgeAt(t, from), this->wedgeAt(t, to) });
    }
  }
  return std::ranges::all_of(this->star(from),
    [&](std::uint32_t t)
    {
      const auto [a, b] = this->others(t, from);
      std::size_t found = 0;
      std::uint32_t onto = 0;
      for (const auto& [one, other] : this->Pairs)
      {
        if (one == this->wedgeAt(t, from) && (found == 0 || other != onto))
        {
          onto = other;
          ++found;
        }
      }
      return a == b || found == 1;
    });
}

/** Of each triangle that disappears, the other two edges become one: gives its groups to the
 * triangle on the other side, at `from` or else at `to`. */
void SurfaceTopology::carryEdges(std::uint32_t from, std::uint32_t to)
{
  for (const std::uint32_t t : this->star(from))
  {
    const auto [a, b] = this->others(t, from);
    if (a == b || (a != to && b != to))
    {
      continue;
    }
    const std::uint32_t opposite = a == to ? b : a;
    GroupSet set = this->edgeSet(t, to, opposite);
    set = set != 0 ? set : this->edgeSet(t, from, opposite);
    bool isCarried = set == 0;
    for (const std::uint32_t end : { from, to })
    {
      for (const std::uint32_t other : this->star(end))
      {
        const auto [c, d] = this->others(other, end);
        const bool isAcross = c != d && other != t && (c == opposite || d == opposite) &&
                              c != from && d != from && c != to && d != to;
        if (!isCarried && isAcross)
        {
          const std::size_t k = this->third(other, end, opposite);
          const GroupSet own = this->Part.edgeSet(other, k);
          this->Part.setEdgeSet(other, k, own != 0 ? own : set);
          isCarried = true;
        }
      }
    }
  }
}

void SurfaceTopology::move(std::uint32_t from, std::uint32_t to)
{
  if (this->Part.edgeGroups)
  {
    this->carryEdges(from, to);
  }
  if (!this->Part.wedges.empty())
  {
    this->findMoves(from, to);
    for (const std::uint32_t t : this->star(from))
    {
      std::uint32_t& wedge = this->wedgeAt(t, from);
      const auto pair =
        std::ranges::find(this->Pairs, wedge, [](const auto& each) { return each[0]; });
      wedge = pair == this->Pairs.end() ? wedge : (*pair)[1];
    }
  }
  this->Target[from] = to;
  this->Touched[from] = this->Touched[to] = ByMove;
}

bool SurfaceTopology::turn(
  std::span<const std::uint32_t> triangles, std::uint32_t v, std::uint32_t to) const
{
  const auto point = [this](std::uint32_t w) { return this->Part.point(w); };
  return !this->MayTurn &&
         std::ranges::any_of(triangles,
           [&](std::uint32_t triangle)
           {
             const auto [a, b] = this->others(triangle, v);
             // This triangle disappears, or has in this pass.
             if (a == b || a == to || b == to)
             {
               return false;
             }
             const Vector edge = difference(point(b), point(a));
             const Vector before = cross(edge, difference(point(v), point(a)));
             const Vector after = cross(edge, difference(point(to), point(a)));
             // The cosine is compared in squares, without roots and divisions. Triangles without
             // area may turn as they like.
             const double product = dot(before, after), size = dot(before, before);
             return size > 0.0 &&
                    !(product > 0.0 &&
                      product * product > MinCosine * MinCosine * size * dot(after, after));
           });
}

double SurfaceTopology::fromBoundary(std::uint32_t from, std::uint32_t to) const
{
  if ((this->Curves[from] & OnBoundary) == 0)
  {
    return 0.0;
  }
  const auto point = [this](std::uint32_t w) { return this->Part.point(w); };
  for (const std::uint32_t t : this->star(from))
  {
    const auto [a, b] = this->others(t, from);
    for (const std::uint32_t w : { a, b })
    {
      if (a != b && w != to && this->hasOneTriangle(from, w))
      {
        const Vector edge = difference(point(w), point(to)),
                     way = difference(point(from), point(to));
        const double length = dot(edge, edge);
        const double at = length > 0.0 ? std::clamp(dot(way, edge) / length, 0.0, 1.0) : 0.0;
        const Vector off{ way[0] - at * edge[0], way[1] - at * edge[1], way[2] - at * edge[2] };
        return dot(off, off);
      }
    }
  }
  return 0.0;
}

/** The edges at v of the boundary, of seams, between labels and in groups; 0 if its triangles have
 * one label, no seam and no edge in a group. More than there are if they are not all in the same
 * groups: there a curve ends. */
std::size_t SurfaceTopology::curvesAt(std::uint32_t v)
{
  const std::span<const std::uint32_t> star = this->star(v);
  if (this->isUniform(star))
  {
    return 0;
  }
  this->Pairs.clear();
  for (const std::uint32_t t : star)
  {
    for (const std::uint32_t w : this->others(t, v))
    {
      this->Pairs.push_back({ w, t });
    }
  }
  std::ranges::sort(this->Pairs);
  std::size_t curves = 0;
  GroupSet groups = 0;
  bool isEnd = false;
  for (std::size_t begin = 0, end = 0; begin < this->Pairs.size(); begin = end)
  {
    bool isAlike = true;
    GroupSet own = 0;
    for (; end < this->Pairs.size() && this->Pairs[end][0] == this->Pairs[begin][0]; ++end)
    {
      own = std::max(own, this->edgeSet(this->Pairs[end][1], v, this->Pairs[begin][0]));
      isAlike = isAlike && this->areAlike(
                             this->Pairs[begin][1], this->Pairs[end][1], v, this->Pairs[begin][0]);
    }
    if (end - begin == 1 || !isAlike)
    {
      isEnd = isEnd || (curves > 0 && own != groups);
      groups = own;
      ++curves;
    }
  }
  return isEnd ? curves + 2 : curves;
}

/** Whether an edge of a vertex that was not touched has not two triangles, or has triangles of
 * different labels, or is on a seam; true if both ends may have further triangles elsewhere. */
bool SurfaceTopology::isCurve(std::uint32_t v, std::uint32_t w) const
{
  if (this->Open[v] != 0 && this->Open[w] != 0)
  {
    return true;
  }
  std::size_t triangles = 0;
  std::uint32_t first = 0;
  for (const std::uint32_t t : this->star(v))
  {
    const auto [a, b] = this->others(t, v);
    if (a != b && (a == w || b == w))
    {
      if (triangles++ > 0 && !this->areAlike(first, t, v, w))
      {
        return true;
      }
      first = t;
    }
  }
  return triangles != 2;
}

/** Whether a move would take a vertex off the border between labels that it is on, or a triangle
 * away that is all that its label has there. */
bool SurfaceTopology::crossesBorders(std::uint32_t from, std::uint32_t to) const
{
  if (!this->KeepsBorders || this->Curves[from] == 0)
  {
    return false;
  }
  if (!this->isCurve(from, to))
  {
    return true;
  }
  return std::ranges::any_of(this->star(from),
    [&](std::uint32_t t)
    {
      const auto [a, b] = this->others(t, from);
      if (a == b || (a != to && b != to))
      {
        return false;
      }
      const std::uint32_t opposite = a == to ? b : a;
      return this->isCurve(from, opposite) && this->isCurve(to, opposite);
    });
}

/** From here on, borders between labels are kept no more. */
void SurfaceTopology::releaseBorders()
{
  this->KeepsBorders = false;
  for (std::size_t v = 0; v < this->Curves.size(); ++v)
  {
    this->Curves[v] &= OnBoundary;
    this->IsFixed[v] &= ByTopology | ByHold;
  }
}

/** Whether the triangles whose other corners are Pairs form one fan, with at most two triangles at
 * each edge. */
bool SurfaceTopology::isFan()
{
  // Of the vertices at a seam, those that stand for no other have no triangles.
  if (this->Pairs.empty())
  {
    return true;
  }
  // Walks along the fan from the first triangle in both directions; those that were passed are
  // moved to the front.
  std::size_t walked = 1;
  for (std::uint32_t end : this->Pairs[0])
  {
    for (std::size_t k = walked; k < this->Pairs.size(); ++k)
    {
      auto& [a, b] = this->Pairs[k];
      if (a == end || b == end)
      {
        end = a == end ? b : a;
        std::swap(this->Pairs[k], this->Pairs[walked]);
        k = walked++;
      }
    }
  }
  // Triangles that the walk has not reached belong to another fan.
  if (walked < this->Pairs.size())
  {
    return false;
  }
  ++this->Mark;
  for (const auto& pair : this->Pairs)
  {
    for (const std::uint32_t w : pair)
    {
      // The third triangle at the edge to w.
      if (this->Common[w] == this->Mark)
      {
        return false;
      }
      (this->Seen[w] == this->Mark ? this->Common : this->Seen)[w] = this->Mark;
    }
  }
  return true;
}

SurfaceTopology::Change SurfaceTopology::changeBy(std::uint32_t from, std::uint32_t to)
{
  if (this->star(to).size() > MaxTriangles)
  {
    return Change::Impossible;
  }
  ++this->Mark;
  std::size_t ofTo = 0, ofFrom = 0; // triangles that have not collapsed in this pass
  for (const std::uint32_t t : this->star(to))
  {
    const auto [a, b] = this->others(t, to);
    ofTo += a != b ? 1 : 0;
    this->Seen[a] = this->Seen[b] = this->Mark;
  }
  std::size_t shared = 0, common = 0;
  this->Across.clear();
  this->Opposite = {};
  for (const std::uint32_t t : this->star(from))
  {
    const auto [a, b] = this->others(t, from);
    for (const std::uint32_t w : { a, b })
    {
      // Two open vertices may be neighbours by triangles elsewhere: they count as neighbours.
      const bool isCommon =
        this->Seen[w] == this->Mark || (this->Open[w] != 0 && this->Open[to] != 0);
      if (w != to && isCommon && this->Common[w] != this->Mark)
      {
        this->Common[w] = this->Mark;
        this->Across.push_back(w);
        ++common;
      }
    }
    ofFrom += a != b ? 1 : 0;
    if (a != b && (a == to || b == to)) // a == b: collapsed in this pass
    {
      this->Opposite[std::min<std::size_t>(shared++, 1)] = a == to ? b : a;
    }
  }
  // Their triangles have gone in this pass; or `from` is on the boundary and would leave it.
  if (shared == 0 || ((this->Curves[from] & OnBoundary) != 0 && shared != 1) ||
      this->crossesBorders(from, to) || (!this->Part.wedges.empty() && !this->findMoves(from, to)))
  {
    return Change::Impossible;
  }
  // All triangles of both are at the edge: they are all of their body.
  if (shared == ofFrom && shared == ofTo && this->Open[to] == 0)
  {
    return Change::Impossible;
  }
  // The link condition: the only common neighbours are the corners opposite to the edge.
  if (shared > 2)
  {
    return Change::Impossible;
  }
  if (common != shared)
  {
    std::erase_if(this->Across,
      [this](std::uint32_t w) { return w == this->Opposite[0] || w == this->Opposite[1]; });
    // None of two triangles that lie on each other.
    return this->Across.empty() ? Change::Impossible : Change::Loop;
  }
  if (shared == 2)
  {
    return this->isTetrahedron(from, to, this->Opposite.data()) ? Change::Vanishing : Change::None;
  }
  // A triangle with two boundary edges may go if there is one other at its third edge. With none it
  // is all of its body, with several all of a sheet. Two open vertices may have others elsewhere.
  const std::uint32_t opposite = this->Opposite[0];
  if (!this->hasOneTriangle(from, opposite))
  {
    return Change::None;
  }
  const std::size_t atThird = this->trianglesAt(to, opposite);
  return atThird == 1                                             ? Change::Impossible
         : atThird > 2 || (this->Open[to] & this->Open[opposite]) ? Change::Sheet
                                                                  : Change::None;
}

/** The triangles of v at the edge to w, of many at least three. */
std::size_t SurfaceTopology::trianglesAt(std::uint32_t v, std::uint32_t w) const
{
  std::size_t triangles = 0;
  for (const std::uint32_t t : this->star(v))
  {
    const auto [a, b] = this->others(t, v);
    triangles += a != b && (a == w || b == w) ? 1 : 0;
    // Both ends of an edge of very many triangles have all of them.
    if (triangles > 2)
    {
      break;
    }
  }
  return triangles;
}

/** Whether both ends of the edge have a triangle with both opposite corners: then the body is a
 * tetrahedron, which would collapse to a doubled triangle. */
bool SurfaceTopology::isTetrahedron(
  std::uint32_t from, std::uint32_t to, const std::uint32_t* opposite) const
{
  const auto hasBoth = [&](std::uint32_t v)
  {
    // Three open vertices may have a triangle elsewhere: it counts as if it were there.
    if (this->Open[v] != 0 && this->Open[opposite[0]] != 0 && this->Open[opposite[1]] != 0)
    {
      return true;
    }
    return std::ranges::any_of(this->star(v),
      [&](std::uint32_t t)
      {
        const auto [a, b] = this->others(t, v);
        return (a == opposite[0] && b == opposite[1]) || (a == opposite[1] && b == opposite[0]);
      });
  };
  return hasBoth(from) && hasBoth(to);
}

/** Replaces corners by where they have gone and removes the triangles that have collapsed. */
void SurfaceTopology::endPass()
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < this->Corners.size(); i += 3)
  {
    this->Polled.at(i / 3);
    const std::uint32_t a = this->Target[this->Corners[i]];
    const std::uint32_t b = this->Target[this->Corners[i + 1]];
    const std::uint32_t c = this->Target[this->Corners[i + 2]];
    if (a != b && b != c && c != a)
    {
      this->Part.moveTriangle(i / 3, kept);
      std::ranges::copy(std::array{ a, b, c },
        this->Part.corners.begin() + 3 * static_cast<std::ptrdiff_t>(kept++));
    }
  }
  this->Part.keepTriangles(kept);
  this->findStars();
}

} // namespace smg
