// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/FanChain.h"

#include <algorithm>

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
  if (this->Trail.size() != count + 1)
  {
    return false;
  }
  this->Corners.assign(1, triangles[0]);
  this->Corners.insert(this->Corners.end(), this->Trail.rbegin(), this->Trail.rend());
  return true;
}

/** Finds the corner at which one more edge begins than ends. If the trail is closed there is none,
 * and `start` is not changed. Returns false if no trail uses all edges. */
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
  return excess <= 1;
}

/**
 * Hierholzer's algorithm: follows edges until none is left, and inserts detours when backtracking.
 */
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

} // namespace smg
