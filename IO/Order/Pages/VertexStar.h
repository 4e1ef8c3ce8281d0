// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/External/Workspace.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** Ranks of vertices, from `begin` to before `end`. */
struct RankRange
{
  std::int64_t begin, end;
  std::int64_t size() const { return this->end - this->begin; }
};

/** The cells of a mesh, distributed to groups of consecutive vertices of equal size. A cell is in
 * the group of each of its corners, so a group has all cells around its vertices. */
class CellGroups
{
public:
  /** The groups of the range have `groupVertices` vertices each; collecting uses `memory` bytes. */
  CellGroups(Workspace& workspace, RankRange range, std::int64_t groupVertices, std::size_t corners,
    std::int64_t memory);

  int groups() const { return this->Cells.buckets(); }
  RankRange range(int group) const
  {
    const std::int64_t begin =
      std::int64_t(this->Begin) + std::int64_t(group) * this->GroupVertices;
    return { begin, std::min(begin + this->GroupVertices, std::int64_t(this->Begin) + this->Size) };
  }
  std::int64_t cells(int group) const
  {
    return this->Cells.bytes(group) / std::int64_t(this->Corners * sizeof(std::uint32_t));
  }

  /** Adds a cell, given the ranks of its corners, some of which may be outside the range. */
  void put(std::span<const std::uint32_t> cell)
  {
    std::uint32_t groups[4];
    for (std::size_t k = 0; k < this->Corners; ++k)
    {
      const std::uint32_t place = cell[k] - this->Begin;
      groups[k] = place < this->Size ? place / this->GroupVertices : None;
      bool isNew = groups[k] != None;
      for (std::size_t other = 0; other < k; ++other)
      {
        isNew = isNew && groups[other] != groups[k];
      }
      if (isNew)
      {
        this->Cells.append(static_cast<int>(groups[k]), std::as_bytes(cell));
      }
    }
  }
  /** To be called after the last put(). */
  void close() { this->Cells.close(); }

  /** Passes the cells of a group to `take`, in the order of put(). */
  template <class Take>
  void forEach(int group, Take&& take) const
  {
    const std::size_t bytes = this->Corners * sizeof(std::uint32_t);
    BucketFile::Reader reader(this->Cells, group);
    for (auto stretch = reader.next(bytes); !stretch.empty(); stretch = reader.next(bytes))
    {
      const auto* ranks = reinterpret_cast<const std::uint32_t*>(stretch.data());
      const std::size_t count = stretch.size() / sizeof(std::uint32_t);
      for (std::size_t i = 0; i < count; i += this->Corners)
      {
        take(std::span(ranks + i, this->Corners));
      }
    }
  }

private:
  static constexpr std::uint32_t None = ~std::uint32_t(0);

  std::size_t Corners;
  std::uint32_t Begin, Size, GroupVertices;
  BucketFile Cells;
};

/**
 * What is around a vertex, from its link (see VertexLinks): its neighbours and, for triangles,
 * whether the mesh is a manifold there. It is used for one vertex of a range after another; a table
 * finds neighbours in the range faster than others.
 *
 * Triangles that have a corner twice connect neighbours, but are not counted as triangles; a
 * triangle that occurs twice counts twice.
 */
class VertexStar
{
public:
  /** `largestLink`: the most ranks in a link; a larger one needs more memory. */
  VertexStar(Pool& pool, RankRange range, std::size_t largestLink);
  /** Its memory in bytes. */
  static std::int64_t bytes(std::int64_t rangeSize, std::size_t largestLink)
  {
    return rangeSize * std::int64_t(sizeof(std::uint32_t)) +
           static_cast<std::int64_t>(largestLink * sizeof(Spoke));
  }

  /**
   * Finds the neighbours of a vertex, each once, not itself.
   * @param neighbours room for as many ranks as the link has
   * @returns how many there are
   */
  std::size_t visit(std::uint32_t vertex, std::span<const std::uint32_t> link, std::size_t corners,
    std::span<std::uint32_t> neighbours);

  // Of the triangles around the last visited vertex:

  /** The number of edges to vertices of higher rank with one triangle. */
  std::int64_t boundaryEdges() const { return this->Boundary; }
  /** The number of edges to vertices of higher rank with more than two triangles. */
  std::int64_t nonManifoldEdges() const { return this->NonManifold; }
  /** The number of groups of triangles that are connected by edges at the vertex: fans and discs.
   * With more than one, the vertex is not manifold. */
  std::int64_t fans() const { return this->Fans; }
  /** Whether neighbour `k` is at the other end of an edge with one triangle. */
  bool isBoundary(std::size_t k) const { return this->spokes()[k].triangles() == 1; }

  // The same, if each pair of the link is in the order in which the triangle runs around the
  // vertex:

  /** The number of edges to vertices of higher rank with two triangles that run along it in the
   * same direction: these are wound against each other. */
  std::int64_t turnedEdges() const { return this->Turned; }
  /** The number of those along which not as many triangles run in one direction as in the other: if
   * there is none, the triangles enclose a volume. */
  std::int64_t unbalancedEdges() const { return this->Unbalanced; }

private:
  /** The data of a neighbour. */
  struct Spoke
  {
    // Of the triangles at the edge, those that run to the neighbour, and from it. No more are
    // counted than there is room for.
    std::uint16_t to, from;
    std::uint32_t parent; ///< in the forest of connected spokes

    int triangles() const { return this->to + this->from; }
  };

  std::uint32_t spoke(std::uint32_t rank, std::span<std::uint32_t> neighbours);
  void findOutside(
    std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours);
  void connectTriangles(
    std::uint32_t vertex, std::span<const std::uint32_t> link, std::span<std::uint32_t> neighbours);
  std::uint32_t root(std::uint32_t spoke);

  std::uint32_t* slots() const { return reinterpret_cast<std::uint32_t*>(this->Slots.data()); }
  Spoke* spokes() const { return reinterpret_cast<Spoke*>(this->Spokes.data()); }

  Pool* Owner;
  std::uint32_t First, Count;
  Buffer Slots; ///< of each vertex of the range: Begin at that time + number among the neighbours
  Buffer Spokes;
  std::uint32_t Begin = 0; ///< grows, so that slots of earlier vertices need not be cleared
  std::uint32_t Found = 0, Outside = 0;
  std::int64_t Boundary = 0, NonManifold = 0, Fans = 0, Turned = 0, Unbalanced = 0;
};

/** The links of a range of vertices. The link of a vertex is, for each cell around it, the ranks of
 * the other corners of the cell: the edges opposite to it in triangles, the faces in tetrahedra. */
class VertexLinks
{
public:
  /** Counts the cells around each vertex of the range, all of which are in the group. */
  VertexLinks(Workspace& workspace, const CellGroups& groups, int group, std::size_t corners);

  /** The number of ranks in the links of the vertices of a part of the range. */
  std::int64_t size(RankRange part) const
  {
    const std::uint64_t* begins = this->begins() - this->Range.begin;
    return static_cast<std::int64_t>(begins[part.end] - begins[part.begin]);
  }
  std::int64_t size() const { return this->size(this->Range); }
  /** The number of ranks in the largest link. */
  std::size_t largest() const { return this->Largest; }
  /** Bytes that load() allocates. */
  std::int64_t bytes() const { return this->size() * std::int64_t(sizeof(std::uint32_t)); }

  /** Collects the links. */
  void load(Workspace& workspace, const CellGroups& groups, int group);

  std::span<const std::uint32_t> of(std::uint32_t vertex) const
  {
    const std::size_t place = vertex - static_cast<std::uint32_t>(this->Range.begin);
    const std::uint64_t* begins = this->begins();
    return { this->ranks() + begins[place],
      static_cast<std::size_t>(begins[place + 1] - begins[place]) };
  }

private:
  std::uint64_t* begins() const { return reinterpret_cast<std::uint64_t*>(this->Begins.data()); }
  std::uint32_t* ranks() const { return reinterpret_cast<std::uint32_t*>(this->Ranks.data()); }

  RankRange Range;
  std::size_t Corners;
  std::size_t Largest = 0;
  Buffer Begins; ///< of the links, and the end of the last
  Buffer Ranks;
};

/** Adds what was found around a vertex of triangles to the counts. */
inline void addCounts(const VertexStar& star, MeshCounts& counts)
{
  counts.boundaryEdges += star.boundaryEdges();
  counts.nonManifoldEdges += star.nonManifoldEdges();
  counts.nonManifoldVertices += star.fans() > 1;
}

/** The neighbours of the vertices of a group of cells, and the counts of triangles around them. */
class GroupStars
{
public:
  GroupStars(Workspace& workspace, const CellGroups& groups, int group, std::size_t corners);

  /** An upper bound of the memory in bytes while it is made, for a group with these numbers of
   * vertices and cells. */
  static std::int64_t maxBytes(std::int64_t vertices, std::int64_t cells, std::size_t corners);

  RankRange range() const { return this->Range; }
  /** The neighbours of a vertex of the range, see VertexStar::visit(). */
  std::span<const std::uint32_t> neighbours(std::uint32_t vertex) const
  {
    const auto* ends = reinterpret_cast<const std::uint64_t*>(this->Ends.data()) +
                       (vertex - static_cast<std::uint32_t>(this->Range.begin));
    return { reinterpret_cast<const std::uint32_t*>(this->Ranks.data()) + ends[0],
      static_cast<std::size_t>(ends[1] - ends[0]) };
  }
  /** The numbers of boundary edges and of non-manifold edges and vertices of triangles; 0 for
   * tetrahedra. */
  const MeshCounts& counts() const { return this->Counts; }

private:
  RankRange Range;
  Buffer Ends; ///< of the neighbours of each vertex, after a 0
  Buffer Ranks;
  MeshCounts Counts;
};

} // namespace smg
