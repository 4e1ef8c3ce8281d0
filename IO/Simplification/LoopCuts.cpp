// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/LoopCuts.h"

#include "Solver/Core/Vector.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

// A loop is looked at within a pass, in which the triangles of a vertex are those at its beginning,
// with corners where they have gone since (SurfaceTopology). So its vertices must be untouched, and
// the search on both sides of it ends at cuts of the same pass: two cuts that are each around a
// handle could together take a part off.
//
// Each cut takes a handle away, or some vertices, so they end. One takes time linear in the
// triangles of the three vertices, times their number at one of them, and in MostSearched.

namespace smg
{
namespace
{

/** So many vertices are searched on either side of a loop for the other one. */
constexpr std::size_t MostSearched = 64;

} // namespace

LoopCuts::LoopCuts(SurfacePart& part, SurfaceTopology& surface, double scale)
  : Part(part)
  , Surface(surface)
  , Scale(scale)
  , Gone(part.vertices())
{
  std::iota(this->Gone.begin(), this->Gone.end(), 0U);
}

/** Whether something of this rank is too large to change; then notes what it costs. */
bool LoopCuts::costsTooMuch(float rank, float limit, Pass& pass)
{
  if (rank <= limit)
  {
    return false;
  }
  pass.least = std::min(pass.least, rank);
  return true;
}

/** The squared radius of the circle inside the triangle of a loop: so far its middle is from the
 * surface. */
double LoopCuts::costOf(const Loop& loop) const
{
  const Vector area = this->Part.area(loop.from, loop.to, loop.across);
  const double length = std::sqrt(this->squaredDistance(loop.from, loop.to)) +
                        std::sqrt(this->squaredDistance(loop.to, loop.across)) +
                        std::sqrt(this->squaredDistance(loop.across, loop.from));
  return length > 0.0 ? dot(area, area) / (length * length) : 0.0;
}

LoopCuts::Loop LoopCuts::leastLoop(std::uint32_t from, std::uint32_t to) const
{
  const auto across = std::ranges::min_element(this->Surface.Across, {},
    [&](std::uint32_t v) {
      return this->costOf({ from, to, v });
    });
  return { from, to, *across };
}

/** The triangles of a vertex that have not collapsed. */
std::size_t LoopCuts::trianglesOf(std::uint32_t v) const
{
  return static_cast<std::size_t>(std::ranges::count_if(this->Surface.star(v),
    [&](std::uint32_t t)
    {
      const auto [a, b] = this->Surface.others(t, v);
      return a != b;
    }));
}

/** Whether the edges of a loop have one triangle each, and a closed fan remains at both ends of the
 * edge that is left. */
bool LoopCuts::isHole(const Loop& loop) const
{
  constexpr std::size_t Least = 3;
  const SurfaceTopology& surface = this->Surface;
  const auto mayClose = [&surface](std::uint32_t v)
  {
    return surface.Curves[v] == SurfaceTopology::OnBoundary && surface.IsFixed[v] == 0 &&
           surface.Touched[v] == 0 && surface.Open[v] == 0;
  };
  return surface.Across.size() == 1 && mayClose(loop.from) && mayClose(loop.to) &&
         mayClose(loop.across) && surface.hasOneTriangle(loop.from, loop.to) &&
         surface.hasOneTriangle(loop.from, loop.across) &&
         surface.hasOneTriangle(loop.to, loop.across) && this->trianglesOf(loop.across) >= Least &&
         this->trianglesOf(loop.from) + this->trianglesOf(loop.to) >= Least + 2;
}

void LoopCuts::closeHole(std::uint32_t to)
{
  const std::uint32_t across = this->Surface.Across[0];
  this->Surface.Touched[to] = this->Surface.Touched[across] = SurfaceTopology::ByCut;
  this->Surface.Curves[to] = this->Surface.Curves[across] = 0;
}

/** Walks from triangle to triangle around v, from a triangle at the edge to `start` away from that
 * edge, to the edge to `end`. Returns whether it comes there. */
bool LoopCuts::walk(std::uint32_t v, std::uint32_t triangle, std::uint32_t start, std::uint32_t end,
  std::vector<std::uint32_t>& passed) const
{
  const std::span<const std::uint32_t> star = this->Surface.star(v);
  passed.assign(1, triangle);
  for (std::uint32_t edge = start; passed.size() <= star.size();)
  {
    const auto [a, b] = this->Surface.others(triangle, v);
    edge = a == edge ? b : a;
    if (edge == end)
    {
      return true;
    }
    const auto next = std::ranges::find_if(star,
      [&](std::uint32_t t)
      {
        const auto [c, d] = this->Surface.others(t, v);
        return t != triangle && c != d && (c == edge || d == edge);
      });
    if (next == star.end())
    {
      return false;
    }
    triangle = *next;
    passed.push_back(triangle);
  }
  return false;
}

/** The triangles of v that are not on the near side. */
void LoopCuts::findRest(
  std::uint32_t v, const std::vector<std::uint32_t>& near, std::vector<std::uint32_t>& far) const
{
  far.clear();
  for (const std::uint32_t t : this->Surface.star(v))
  {
    const auto [a, b] = this->Surface.others(t, v);
    if (a != b && std::ranges::find(near, t) == near.end())
    {
      far.push_back(t);
    }
  }
}

/** Whether the ends of the edge have one common neighbour on this side of the loop. */
bool LoopCuts::shareOne(const Side& side, const Loop& loop)
{
  std::vector<std::uint32_t>& seen = this->Surface.Seen;
  std::vector<std::uint32_t>& common = this->Surface.Common;
  const std::uint32_t mark = ++this->Surface.Mark;
  for (const std::uint32_t t : side.from)
  {
    for (const std::uint32_t w : this->Surface.others(t, loop.from))
    {
      seen[w] = mark;
    }
  }
  std::size_t shared = 0;
  for (const std::uint32_t t : side.to)
  {
    for (const std::uint32_t w : this->Surface.others(t, loop.to))
    {
      if (w != loop.from && w != loop.across && seen[w] == mark && common[w] != mark)
      {
        common[w] = mark;
        ++shared;
      }
    }
  }
  return shared == 1;
}

/** Finds the triangles on both sides of a loop. Returns whether the surface can be cut there: the
 * sides are two, and each remains a surface when its rim is closed. */
bool LoopCuts::findSides(const Loop& loop)
{
  const auto [from, to, across] = loop;
  if (!this->isPlain(from) || !this->isPlain(to) || !this->isPlain(across))
  {
    return false;
  }
  const std::span<const std::uint32_t> star = this->Surface.star(from);
  const auto first = std::ranges::find_if(star,
    [&](std::uint32_t t)
    {
      const auto [a, b] = this->Surface.others(t, from);
      return a != b && (a == to || b == to);
    });
  Side& near = this->Near;
  if (first == star.end() || !this->walk(from, *first, to, across, near.from) ||
      !this->walk(to, *first, from, across, near.to) ||
      !this->walk(across, near.from.back(), from, to, near.across) ||
      near.across.back() != near.to.back())
  {
    return false;
  }
  this->findRest(from, near.from, this->Far.from);
  this->findRest(to, near.to, this->Far.to);
  this->findRest(across, near.across, this->Far.across);
  // At least three triangles are left around each vertex.
  const auto isLarge = [](const Side& side)
  { return side.from.size() + side.to.size() >= 5 && side.across.size() >= 3; };
  return isLarge(near) && isLarge(this->Far) && this->shareOne(near, loop) &&
         this->shareOne(this->Far, loop);
}

/** One step of a search outwards from a loop on one side: marks and lists the corners of triangles.
 * Vertices of this side are marked in Seen, of the other one in Common, or the other way round. */
LoopCuts::Met LoopCuts::spread(std::span<const std::uint32_t> triangles, bool isNear)
{
  std::vector<std::uint32_t>& own = isNear ? this->Surface.Seen : this->Surface.Common;
  const std::vector<std::uint32_t>& other = isNear ? this->Surface.Common : this->Surface.Seen;
  std::vector<std::uint32_t>& found = isNear ? this->NearVertices : this->FarVertices;
  const std::uint32_t mark = this->Surface.Mark;
  for (const std::uint32_t t : triangles)
  {
    const std::uint32_t* c = this->Part.corners.data() + 3 * std::size_t(t);
    for (const std::uint32_t w : { c[0], c[1], c[2] })
    {
      if (own[w] == mark)
      {
        continue;
      }
      if (other[w] == mark)
      {
        return Met::OtherSide;
      }
      if (this->Surface.Touched[w] == SurfaceTopology::ByCut)
      {
        return Met::Cut;
      }
      own[w] = mark;
      found.push_back(w);
    }
  }
  return Met::Nothing;
}

/** After findSides(); the vertices of a bump are then NearVertices. */
LoopCuts::Kind LoopCuts::kindOf(const Loop& loop)
{
  ++this->Surface.Mark;
  for (const std::uint32_t v : { loop.from, loop.to, loop.across })
  {
    this->Surface.Seen[v] = this->Surface.Common[v] = this->Surface.Mark;
  }
  this->NearVertices.clear();
  this->FarVertices.clear();
  Met met = Met::Nothing;
  const auto look = [&](std::span<const std::uint32_t> triangles, bool isNear)
  { met = met == Met::Nothing ? this->spread(triangles, isNear) : met; };
  for (const bool isNear : { true, false })
  {
    const Side& side = isNear ? this->Near : this->Far;
    look(side.from, isNear);
    look(side.to, isNear);
    look(side.across, isNear);
  }
  for (std::size_t k = 0; k < MostSearched && met == Met::Nothing; ++k)
  {
    if (k == this->NearVertices.size() || k == this->FarVertices.size())
    {
      if (k != this->NearVertices.size())
      {
        std::swap(this->NearVertices, this->FarVertices);
      }
      return Kind::Bump;
    }
    look(this->Surface.star(this->NearVertices[k]), true);
    look(this->Surface.star(this->FarVertices[k]), false);
  }
  return met == Met::OtherSide ? Kind::Handle : Kind::Neck;
}

LoopCuts::Done LoopCuts::cut(
  std::uint32_t from, std::uint32_t to, float rank, float limit, Pass& pass)
{
  const Loop loop = this->leastLoop(from, to);
  const double cost = this->costOf(loop);
  if (costsTooMuch(std::max(rank, this->rankOf(cost)), limit, pass))
  {
    return Done::Nothing;
  }
  if (this->isHole(loop))
  {
    return Done::Hole;
  }
  if (!this->findSides(loop))
  {
    return Done::Nothing;
  }
  const Kind kind = this->kindOf(loop);
  const bool isCut = kind == Kind::Handle ? this->cutHandle(loop, pass)
                                          : kind == Kind::Bump && this->cutOff(loop, limit, pass);
  pass.error = isCut ? std::max(pass.error, cost) : pass.error;
  return isCut ? Done::Cut : Done::Nothing;
}

bool LoopCuts::cutHandle(const Loop& loop, Pass& pass)
{
  const auto [from, to, across] = loop;
  if (this->Surface.turn(this->Near.to, to, from) || this->Surface.turn(this->Far.from, from, to))
  {
    return false;
  }
  std::uint32_t copy = this->takeGone(across, across);
  for (std::size_t k = 0; k < this->NearVertices.size() && copy == across; ++k)
  {
    // What has gone in this pass is not yet free.
    const std::uint32_t owner = this->NearVertices[k];
    copy = this->Surface.Touched[owner] == 0 ? this->takeGone(across, owner) : across;
  }
  if (copy == across)
  {
    return false;
  }
  std::vector<Quadric>& quadrics = this->Part.quadrics;
  quadrics[copy] = quadrics[across];
  quadrics[from].add(quadrics[to]);
  quadrics[to] = quadrics[from];
  this->replace(this->Near.to, to, from);
  this->replace(this->Far.from, from, to);
  this->replace(this->Near.across, across, copy);
  this->Surface.Target[copy] = copy;
  this->Surface.IsFixed[copy] = this->Surface.Curves[copy] = 0;
  for (const std::uint32_t v : { from, to, across, copy })
  {
    this->Surface.Touched[v] = SurfaceTopology::ByCut;
  }
  ++pass.came;
  return true;
}

/** Takes one of the vertices that have gone to `owner`, the nearest of some, for the triangles of v
 * on the near side; v if there is none. */
std::uint32_t LoopCuts::takeGone(std::uint32_t v, std::uint32_t owner)
{
  constexpr int Most = 32;
  std::uint32_t before = owner;
  double least = HUGE_VAL;
  std::uint32_t at = owner;
  for (int k = 0; k < Most && this->Gone[at] != owner; ++k, at = this->Gone[at])
  {
    const std::uint32_t gone = this->Gone[at];
    const double distance = this->squaredDistance(gone, v);
    if (distance < least && this->Part.seamOf(gone) == 0 &&
        !this->Surface.turn(this->Near.across, v, gone))
    {
      least = distance;
      before = at;
    }
  }
  if (!(least < HUGE_VAL))
  {
    return v;
  }
  const std::uint32_t taken = this->Gone[before];
  this->Gone[before] = std::exchange(this->Gone[taken], taken);
  return taken;
}

/** Gives a corner of triangles to another vertex. */
void LoopCuts::replace(std::span<const std::uint32_t> triangles, std::uint32_t v, std::uint32_t by)
{
  for (const std::uint32_t t : triangles)
  {
    for (std::size_t i = 3 * std::size_t(t); i < 3 * std::size_t(t + 1); ++i)
    {
      if (this->Part.corners[i] == v)
      {
        this->Part.corners[i] = by;
        if (!this->Part.wedges.empty())
        {
          this->Part.wedges[i] = by;
        }
      }
    }
  }
}

/** Gives the places of a vertex in triangles, where seams are joined, to another vertex. */
void LoopCuts::replaceWedges(std::uint32_t v, std::uint32_t by)
{
  for (const std::uint32_t t : this->Surface.star(v))
  {
    for (std::size_t i = 3 * std::size_t(t);
         i < 3 * std::size_t(t + 1) && !this->Part.wedges.empty(); ++i)
    {
      this->Part.wedges[i] = this->Part.corners[i] == v ? by : this->Part.wedges[i];
    }
  }
}

/** Replaces a bump by the triangle of the loop, which the triangle at the edge between the other
 * two vertices becomes as all vertices of the bump move onto `to`. */
bool LoopCuts::cutOff(const Loop& loop, float limit, Pass& pass)
{
  if (pass.gone + this->NearVertices.size() > pass.most)
  {
    return false;
  }
  double size = 0.0;
  for (const std::uint32_t v : this->NearVertices)
  {
    if (!this->isPlain(v))
    {
      return false;
    }
    size =
      std::max(size, std::min({ this->squaredDistance(v, loop.from),
                       this->squaredDistance(v, loop.to), this->squaredDistance(v, loop.across) }));
  }
  if (costsTooMuch(this->rankOf(size), limit, pass))
  {
    return false;
  }
  pass.error = std::max(pass.error, size);
  for (const std::uint32_t v : this->NearVertices)
  {
    this->replaceWedges(v, loop.to);
    this->Surface.Target[v] = loop.to;
    this->Surface.Touched[v] = SurfaceTopology::ByCut;
  }
  for (const std::uint32_t v : { loop.from, loop.to, loop.across })
  {
    this->Surface.Touched[v] = SurfaceTopology::ByCut;
  }
  pass.gone += this->NearVertices.size();
  return true;
}

bool LoopCuts::removeBody(std::uint32_t from, std::uint32_t to, float limit, Pass& pass)
{
  const std::array<std::uint32_t, 4> body{ from, to, this->Surface.Opposite[0],
    this->Surface.Opposite[1] };
  double size = 0.0;
  for (const std::uint32_t v : body)
  {
    if (!this->isPlain(v) || this->Surface.star(v).size() != 3)
    {
      return false;
    }
    for (const std::uint32_t w : body)
    {
      size = std::max(size, this->squaredDistance(v, w));
    }
  }
  if (costsTooMuch(this->rankOf(size), limit, pass))
  {
    return false;
  }
  pass.error = std::max(pass.error, size);
  for (const std::uint32_t v : body)
  {
    this->Surface.Target[v] = to;
    this->Surface.Touched[v] = SurfaceTopology::ByCut;
  }
  pass.gone += body.size();
  ++pass.bodies;
  return true;
}

bool LoopCuts::mayRemoveSheet(std::uint32_t from, std::uint32_t to, float limit, Pass& pass) const
{
  const std::uint32_t opposite = this->Surface.Opposite[0];
  if (this->Surface.trianglesAt(to, opposite) <= 2)
  {
    return true;
  }
  // It is at most so far from what is left.
  const double size =
    std::min(this->squaredDistance(from, to), this->squaredDistance(from, opposite));
  if (costsTooMuch(this->rankOf(size), limit, pass))
  {
    return false;
  }
  pass.error = std::max(pass.error, size);
  return true;
}

} // namespace smg
