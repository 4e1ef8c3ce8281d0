// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/TriangleChains.h"

#include <algorithm>
#include <iterator>

// The last two corners of the triangles of a fan are edges of a graph, and the polygon is an Euler
// trail of it: Hierholzer's algorithm finds it whatever the order of the triangles, and even if
// corners are repeated.

namespace smg
{

bool FanChain::build(std::span<const std::uint32_t> triangles)
{
  const std::size_t count = triangles.size() / 3;
  this->Edges.clear();
  this->Ends.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::span<const std::uint32_t> triangle = triangles.subspan(3 * i, 3);
    // A fan has one corner in all of its triangles, and it is the first one.
    if (triangle[0] != triangles[0])
    {
      return false;
    }
    this->Edges.emplace_back(triangle[1], triangle[2]);
    this->Ends.push_back(triangle[2]);
  }
  std::uint32_t start = this->Edges[0].first;
  std::stable_sort(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b) { return a.first < b.first; });
  std::sort(this->Ends.begin(), this->Ends.end());
  if (!this->findStart(start))
  {
    return false;
  }
  this->walk(start);
  // The edges fall into several pieces.
  if (this->Trail.size() != count + 1)
  {
    return false;
  }
  this->Corners.assign(1, triangles[0]);
  this->Corners.insert(this->Corners.end(), this->Trail.rbegin(), this->Trail.rend());
  return true;
}

/** Finds the start of the trail: the corner at which one more edge begins than ends. A closed trail
 * has none; `start` does not change then. Returns false if no trail can use all edges. */
bool FanChain::findStart(std::uint32_t& start) const
{
  std::size_t begins = 0;
  std::size_t excess = 0;
  std::size_t end = 0;
  while (begins < this->Edges.size())
  {
    const std::uint32_t corner = this->Edges[begins].first;
    const std::size_t before = begins;
    while (begins < this->Edges.size() && this->Edges[begins].first == corner)
    {
      ++begins;
    }
    while (end < this->Ends.size() && this->Ends[end] < corner)
    {
      ++end;
    }
    const std::size_t firstEnd = end;
    while (end < this->Ends.size() && this->Ends[end] == corner)
    {
      ++end;
    }
    const std::size_t out = begins - before;
    const std::size_t in = end - firstEnd;
    if (out > in)
    {
      start = corner;
      excess += out - in;
    }
  }
  // The degrees allow a trail; whether the edges are connected shows when it is walked.
  return excess <= 1;
}

/** Hierholzer's algorithm: follows unused edges until there is none, and inserts detours on the way
 * back. The trail comes out from its end to its start. */
void FanChain::walk(std::uint32_t start)
{
  this->Taken.assign(this->Edges.size(), 0);
  this->Trail.clear();
  this->Stack.assign(1, start);
  while (!this->Stack.empty())
  {
    const std::uint32_t corner = this->Stack.back();
    const auto first = std::lower_bound(this->Edges.begin(), this->Edges.end(), corner,
      [](const Edge& edge, std::uint32_t c) { return edge.first < c; });
    // Edges are sorted by their first corner: those of a corner follow each other, and Taken counts
    // how many were used.
    const auto place = static_cast<std::size_t>(first - this->Edges.begin());
    const std::size_t edge =
      place < this->Edges.size() ? place + this->Taken[place] : this->Edges.size();
    if (edge < this->Edges.size() && this->Edges[edge].first == corner)
    {
      ++this->Taken[place];
      this->Stack.push_back(this->Edges[edge].second);
    }
    else
    {
      this->Trail.push_back(corner);
      this->Stack.pop_back();
    }
  }
}

bool StripChain::build(std::span<const std::uint32_t> triangles)
{
  const std::size_t count = triangles.size() / 3;
  const auto triangle = [&triangles](std::uint32_t place)
  { return triangles.subspan(3 * std::size_t(place), 3); };
  this->Begins.clear();
  for (std::uint32_t place = 0; place < count; ++place)
  {
    const std::span<const std::uint32_t> corners = triangle(place);
    this->Begins.push_back({ { corners[0], corners[1] }, place });
  }
  std::ranges::sort(this->Begins);
  const auto sameBegin = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (std::ranges::adjacent_find(this->Begins, sameBegin) != this->Begins.end())
  {
    return false;
  }

  std::vector<bool> follows(count);
  for (std::uint32_t place = 0; place < count; ++place)
  {
    for (const bool isEven : { false, true })
    {
      if (const std::uint32_t next = this->after(triangle(place), isEven); next != None)
      {
        follows[next] = true;
      }
    }
  }
  const auto first = std::ranges::find(follows, false);
  if (first == follows.end())
  {
    return false;
  }
  this->Order.clear();
  std::vector<bool> taken(count);
  for (auto next = static_cast<std::uint32_t>(first - follows.begin());
       next != None && !taken[next];
       next = this->after(triangle(next), this->Order.size() % 2 == 1))
  {
    taken[next] = true;
    this->Order.push_back(next);
  }
  return this->Order.size() == count;
}

std::uint32_t StripChain::after(std::span<const std::uint32_t> triangle, bool isEven) const
{
  const Edge begin = isEven ? Edge{ triangle[2], triangle[1] } : Edge{ triangle[0], triangle[2] };
  const auto found = std::ranges::lower_bound(
    this->Begins, begin, {}, [](const auto& entry) { return entry.first; });
  return found != this->Begins.end() && found->first == begin ? found->second : None;
}

bool PolygonTree::build(std::span<const std::uint32_t> triangles)
{
  const std::size_t count = triangles.size() / 3;
  this->Bases.clear();
  this->Sides.clear();
  for (std::uint32_t place = 0; place < count; ++place)
  {
    const std::span<const std::uint32_t> corners = triangles.subspan(3 * std::size_t(place), 3);
    this->Bases.push_back({ { corners[0], corners[2] }, place });
    this->Sides.insert(
      this->Sides.end(), { { corners[0], corners[1] }, { corners[1], corners[2] } });
  }
  std::ranges::sort(this->Bases);
  std::ranges::sort(this->Sides);
  // Each triangle but the root has a side of another one as its base. Where corners are repeated,
  // the base of the root may be such a side, too: then any may be the root.
  const std::size_t surplus = this->findRoots();
  const bool mayBeAny = surplus == 0 && count <= MostRoots;
  if (mayBeAny)
  {
    std::ranges::transform(
      this->Bases, std::back_inserter(this->Roots), [](const auto& base) { return base.second; });
  }
  return (surplus == 1 || mayBeAny) && std::ranges::any_of(this->Roots, [&](std::uint32_t root)
                                         { return this->unfold(triangles, root); });
}

/** Collects triangles whose base is the side of none. Returns by how many there are more of them
 * than sides. */
std::size_t PolygonTree::findRoots()
{
  this->Roots.clear();
  std::size_t surplus = 0;
  for (auto base = this->Bases.begin(); base != this->Bases.end();)
  {
    const Edge& edge = base->first;
    const auto end = std::find_if(
      base, this->Bases.end(), [&edge](const auto& other) { return other.first != edge; });
    const auto here = static_cast<std::size_t>(end - base);
    const std::size_t sides = std::ranges::equal_range(this->Sides, edge).size();
    if (here > sides)
    {
      this->Roots.push_back(base->second);
      surplus += here - sides;
    }
    base = end;
  }
  return surplus;
}

/** Replaces the base of the root by its sides, and these by those of the triangles whose bases they
 * are; returns whether all triangles have been used. */
bool PolygonTree::unfold(std::span<const std::uint32_t> triangles, std::uint32_t root)
{
  const std::size_t count = triangles.size() / 3;
  this->Taken.assign(count, 0);
  this->Order.clear();
  const Edge whole{ triangles[3 * std::size_t(root)], triangles[3 * std::size_t(root) + 2] };
  this->Corners.assign(1, whole.first);
  this->Stack.assign(1, whole);
  while (!this->Stack.empty())
  {
    const Edge edge = this->Stack.back();
    this->Stack.pop_back();
    const std::uint32_t next = this->take(edge);
    if (next == None)
    {
      this->Corners.push_back(edge.second);
      continue;
    }
    this->Order.push_back(next);
    const std::uint32_t middle = triangles[3 * std::size_t(next) + 1];
    this->Stack.push_back({ middle, edge.second });
    this->Stack.push_back({ edge.first, middle });
  }
  return this->Order.size() == count;
}

/** The next triangle with this base, each once. */
std::uint32_t PolygonTree::take(const Edge& edge)
{
  const auto first =
    std::ranges::lower_bound(this->Bases, edge, {}, [](const auto& entry) { return entry.first; });
  const auto place = static_cast<std::size_t>(first - this->Bases.begin());
  if (place == this->Bases.size() || first->first != edge)
  {
    return None;
  }
  const std::size_t next = place + this->Taken[place];
  if (next == this->Bases.size() || this->Bases[next].first != edge)
  {
    return None;
  }
  ++this->Taken[place];
  return this->Bases[next].second;
}

} // namespace smg
