// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/VertexStar.h"

#include <algorithm>
#include <cassert>

// What is around the vertices of a range, from the cells of a group: neighbours, and for surfaces
// the edges and vertices that are on the boundary or not manifold.
//
// The neighbours of a vertex are found in time linear in its link: those in the range by a table
// that is not cleared between vertices (its entries are numbers that only grow), those outside of
// it, which are few, by sorting. Triangles around a vertex that share an edge there are joined in a
// forest; more than one tree means that the surface is not manifold at the vertex.

namespace smg
{

CellGroups::CellGroups(Workspace& workspace, RankRange range, std::int64_t groupVertices,
  std::size_t corners, std::int64_t memory)
  : Corners(corners)
  , Begin(static_cast<std::uint32_t>(range.begin))
  , Size(static_cast<std::uint32_t>(range.size()))
  , GroupVertices(static_cast<std::uint32_t>(groupVertices))
  , Cells(workspace,
      static_cast<int>(
        std::max<std::int64_t>(1, (range.size() + groupVertices - 1) / groupVertices)),
      memory)
{
}

VertexStar::VertexStar(Pool& pool, RankRange range, std::size_t largestLink)
  : Owner(&pool)
  , First(static_cast<std::uint32_t>(range.begin))
  , Count(static_cast<std::uint32_t>(range.size()))
  , Slots(pool, std::size_t(this->Count) * sizeof(std::uint32_t))
  , Spokes(pool, largestLink * sizeof(Spoke))
{
  // No entry is of the current vertex: all are far from Begin.
  std::fill_n(this->slots(), this->Count, ~std::uint32_t(0));
}

/** Begins the list of neighbours with those outside the range, in ascending order, each once. */
void VertexStar::findOutside(
  std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours)
{
  std::size_t outside = 0;
  for (const std::uint32_t rank : link)
  {
    // Written without a branch, since few are outside and which ones is unpredictable.
    neighbours[outside] = rank;
    outside += rank - this->First >= this->Count && rank != vertex;
    if (outside == neighbours.size())
    {
      break;
    }
  }
  if (outside > 0)
  {
    const auto begin = neighbours.begin();
    std::sort(begin, begin + std::ptrdiff_t(outside));
    outside = static_cast<std::size_t>(std::unique(begin, begin + std::ptrdiff_t(outside)) - begin);
  }
  this->Outside = this->Found = static_cast<std::uint32_t>(outside);
  for (std::uint32_t i = 0; i < this->Found; ++i)
  {
    this->spokes()[i] = { 0, 0, i };
  }
}

/** The number of a neighbour in the list, to which it is added if it is new. */
std::uint32_t VertexStar::spoke(std::uint32_t rank, std::span<std::uint32_t> neighbours)
{
  const std::uint32_t place = rank - this->First;
  // Neighbours outside of the range have been listed before.
  if (place >= this->Count)
  {
    const auto outside = neighbours.first(this->Outside);
    return static_cast<std::uint32_t>(std::ranges::lower_bound(outside, rank) - outside.begin());
  }
  std::uint32_t& slot = this->slots()[place];
  // The entry is of an earlier vertex, hence below Begin, and wraps around to a large number.
  if (slot - this->Begin >= this->Found)
  {
    slot = this->Begin + this->Found;
    neighbours[this->Found] = rank;
    this->spokes()[this->Found] = { 0, 0, this->Found };
    ++this->Found;
  }
  return slot - this->Begin;
}

std::uint32_t VertexStar::root(std::uint32_t spoke)
{
  Spoke* spokes = this->spokes();
  while (spokes[spoke].parent != spoke)
  {
    spoke = spokes[spoke].parent = spokes[spokes[spoke].parent].parent;
  }
  return spoke;
}

/** Counts the triangles at each edge of the vertex, and joins the edges that a triangle
 * connects. */
void VertexStar::connectTriangles(
  std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours)
{
  Spoke* spokes = this->spokes();
  this->Boundary = this->NonManifold = this->Fans = this->Turned = this->Unbalanced = 0;
  const auto count = [](std::uint16_t& triangles)
  { triangles = static_cast<std::uint16_t>(triangles + (triangles != UINT16_MAX)); };
  for (std::size_t i = 0; i < link.size(); i += 2)
  {
    const std::uint32_t ends[] = { link[i], link[i + 1] };
    // A triangle with a repeated corner has no area: its corners are neighbours, but it is not
    // counted.
    if (ends[0] == ends[1] || ends[0] == vertex || ends[1] == vertex)
    {
      for (const std::uint32_t end : ends)
      {
        if (end != vertex)
        {
          this->spoke(end, neighbours);
        }
      }
      continue;
    }
    const std::uint32_t a = this->spoke(ends[0], neighbours);
    const std::uint32_t b = this->spoke(ends[1], neighbours);
    // An edge with its first triangle begins a fan of its own; joining two fans leaves one fewer.
    this->Fans += (spokes[a].triangles() == 0) + (spokes[b].triangles() == 0);
    count(spokes[a].to);
    count(spokes[b].from);
    const std::uint32_t rootA = this->root(a), rootB = this->root(b);
    this->Fans -= rootA != rootB;
    spokes[std::max(rootA, rootB)].parent = std::min(rootA, rootB);
  }
  for (std::uint32_t i = 0; i < this->Found; ++i)
  {
    // Each edge is counted at its lower end, so once.
    const bool counted = neighbours[i] > vertex;
    const Spoke& edge = spokes[i];
    this->Boundary += counted && edge.triangles() == 1;
    this->NonManifold += counted && edge.triangles() > 2;
    this->Turned += counted && edge.triangles() == 2 && edge.to != 1;
    this->Unbalanced += counted && edge.to != edge.from;
  }
}

std::size_t VertexStar::visit(std::uint32_t vertex, std::span<const std::uint32_t> link,
  std::size_t corners, std::span<std::uint32_t> neighbours)
{
  assert(neighbours.size() >= link.size());
  if (const std::size_t bytes = link.size() * sizeof(Spoke); bytes > this->Spokes.size())
  {
    this->Spokes.grow(*this->Owner, bytes + bytes / 2);
  }
  // Before the numbers overflow, the table is cleared and they begin again.
  if (std::uint64_t(this->Begin) + 2 * link.size() > ~std::uint32_t(0))
  {
    std::fill_n(this->slots(), this->Count, ~std::uint32_t(0));
    this->Begin = 0;
  }
  this->findOutside(vertex, link, neighbours);
  if (corners == 3)
  {
    this->connectTriangles(vertex, link, neighbours);
  }
  else
  {
    for (const std::uint32_t rank : link)
    {
      if (rank != vertex)
      {
        this->spoke(rank, neighbours);
      }
    }
  }
  this->Begin += this->Found;
  return this->Found;
}

VertexLinks::VertexLinks(
  Workspace& workspace, const CellGroups& groups, int group, std::size_t corners)
  : Range(groups.range(group))
  , Corners(corners)
  , Begins(workspace.pool(), static_cast<std::size_t>(this->Range.size() + 1) * 8)
{
  const auto count = static_cast<std::size_t>(this->Range.size());
  const auto first = static_cast<std::uint32_t>(this->Range.begin);
  std::uint64_t* begins = this->begins();
  // First the number of cells around each vertex, then the offset of each link: a counting sort in
  // two passes over the group.
  std::fill_n(begins, count + 1, 0);
  groups.forEach(group,
    [&](std::span<const std::uint32_t> cell)
    {
      for (const std::uint32_t rank : cell)
      {
        const std::uint32_t place = rank - first;
        if (place < count)
        {
          ++begins[place];
        }
      }
    });
  std::uint64_t sum = 0;
  for (std::size_t place = 0; place <= count; ++place)
  {
    const std::uint64_t link = begins[place] * (corners - 1);
    this->Largest = std::max(this->Largest, static_cast<std::size_t>(link));
    begins[place] = sum;
    sum += link;
  }
}

void VertexLinks::load(Workspace& workspace, const CellGroups& groups, int group)
{
  this->Ranks = Buffer(workspace.pool(), static_cast<std::size_t>(this->bytes()));
  const auto count = static_cast<std::size_t>(this->Range.size());
  const auto first = static_cast<std::uint32_t>(this->Range.begin);
  std::uint64_t* begins = this->begins();
  std::uint32_t* ranks = this->ranks();
  groups.forEach(group,
    [&](std::span<const std::uint32_t> cell)
    {
      for (std::size_t k = 0; k < cell.size(); ++k)
      {
        const std::uint32_t place = cell[k] - first;
        if (place < count)
        {
          for (std::size_t other = 0; other < cell.size(); ++other)
          {
            if (other != k)
            {
              ranks[begins[place]++] = cell[other];
            }
          }
        }
      }
    });
  // Each offset has moved to that of the next link. Shifted by one place they are right again.
  std::copy_backward(begins, begins + count, begins + count + 1);
  begins[0] = 0;
}

GroupStars::GroupStars(
  Workspace& workspace, const CellGroups& groups, int group, std::size_t corners)
  : Range(groups.range(group))
  , Ends(workspace.pool(), static_cast<std::size_t>(this->Range.size() + 1) * sizeof(std::uint64_t))
{
  this->Counts.boundaryEdges = this->Counts.nonManifoldEdges = 0;
  this->Counts.nonManifoldVertices = 0;
  VertexLinks links(workspace, groups, group, corners);
  links.load(workspace, groups, group);
  VertexStar star(workspace.pool(), this->Range, links.largest());
  this->Ranks = Buffer(workspace.pool(), static_cast<std::size_t>(links.bytes()));
  const std::span ranks(
    reinterpret_cast<std::uint32_t*>(this->Ranks.data()), static_cast<std::size_t>(links.size()));
  auto* ends = reinterpret_cast<std::uint64_t*>(this->Ends.data());
  std::uint64_t end = *ends = 0;
  for (std::int64_t rank = this->Range.begin; rank < this->Range.end; ++rank)
  {
    const auto vertex = static_cast<std::uint32_t>(rank);
    end += star.visit(vertex, links.of(vertex), corners, ranks.subspan(end));
    *++ends = end;
    if (corners == 3)
    {
      addCounts(star, this->Counts);
    }
  }
}

std::int64_t GroupStars::maxBytes(std::int64_t vertices, std::int64_t cells, std::size_t corners)
{
  const auto links = static_cast<std::int64_t>(corners * (corners - 1)) * cells;
  // Links and neighbours have ends and ranks each; a buffer is rounded up, and a reader has a
  // chunk.
  return 2 * (vertices + 1) * std::int64_t(sizeof(std::uint64_t)) +
         2 * links * std::int64_t(sizeof(std::uint32_t)) +
         VertexStar::bytes(vertices, static_cast<std::size_t>(links)) +
         std::int64_t(BucketFile::ChunkBytes) + 1024;
}

} // namespace smg
