// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/TriangleChains.h"

#include <algorithm>

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
  for (std::uint32_t place = 0; place < count; ++place)
  {
    this->Bases.push_back({ { triangles[3 * place], triangles[3 * place + 2] }, place });
  }
  std::ranges::sort(this->Bases);
  const auto sameBase = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (std::ranges::adjacent_find(this->Bases, sameBase) != this->Bases.end())
  {
    return false;
  }

  // Each triangle but the root lies behind a side of one other triangle.
  std::vector<bool> isBehind(count);
  std::size_t behind = 0;
  for (std::size_t k = 0; k < triangles.size(); k += 3)
  {
    for (const Edge& side :
      { Edge{ triangles[k], triangles[k + 1] }, Edge{ triangles[k + 1], triangles[k + 2] } })
    {
      if (const std::uint32_t next = this->behind(side); next != None && !isBehind[next])
      {
        isBehind[next] = true;
        ++behind;
      }
    }
  }
  if (behind + 1 != count)
  {
    return false;
  }

  const auto root = static_cast<std::size_t>(std::ranges::find(isBehind, false) - isBehind.begin());
  this->Corners.assign(1, triangles[3 * root]);
  this->Stack.assign(1, { triangles[3 * root], triangles[3 * root + 2] });
  while (!this->Stack.empty())
  {
    const Edge side = this->Stack.back();
    this->Stack.pop_back();
    const std::uint32_t next = this->behind(side);
    if (next == None)
    {
      this->Corners.push_back(side.second);
      if (this->Corners.size() > count + 2)
      {
        return false;
      }
      continue;
    }
    const std::uint32_t middle = triangles[3 * std::size_t(next) + 1];
    this->Stack.push_back({ middle, side.second });
    this->Stack.push_back({ side.first, middle });
  }
  return this->Corners.size() == count + 2;
}

std::uint32_t PolygonTree::behind(const Edge& edge) const
{
  const auto found =
    std::ranges::lower_bound(this->Bases, edge, {}, [](const auto& entry) { return entry.first; });
  return found != this->Bases.end() && found->first == edge ? found->second : None;
}

} // namespace smg
