// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/Arrival.h"
#include "Solver/Jobs/Distance/ChunkMarch.h"
#include "Solver/Jobs/Distance/FrontQueue.h"
#include "Solver/Jobs/Distance/LineOfSight.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>

namespace smg
{

/** A priority queue of the vertices of a window by their distances: a heap with four children per
 * node. Distances are compared by their leading 21 binary digits only, which keeps an entry at 8
 * bytes and suffices for a march that corrects. */
class MarchQueue
{
public:
  MarchQueue(Pool& pool, std::int64_t vertices)
    : Memory(pool, static_cast<std::size_t>(vertices + 1) * sizeof(Entry))
    , PlaceMemory(pool, static_cast<std::size_t>(vertices) * sizeof(std::uint32_t))
    , Heap(reinterpret_cast<Entry*>(this->Memory.data()))
    , Places(reinterpret_cast<std::uint32_t*>(this->PlaceMemory.data()))
  {
    std::memset(this->Places, 0, this->PlaceMemory.size());
  }

  /** The bytes of a queue for this many vertices. */
  static constexpr std::int64_t bytes(std::int64_t vertices)
  {
    return (vertices + 1) * std::int64_t(sizeof(Entry) + sizeof(std::uint32_t));
  }

  bool isEmpty() const { return this->Size == 0; }

  /** Adds the vertex, or moves it forward if it is in the queue. */
  void put(std::uint32_t vertex, double distance)
  {
    const Entry entry{ FrontQueue::keyOf(distance), vertex };
    std::uint32_t place = this->Places[vertex];
    if (place == 0)
    {
      place = ++this->Size;
    }
    while (place > 1)
    {
      const std::uint32_t parent = (place + 2) / 4;
      if (this->Heap[parent].key <= entry.key)
      {
        break;
      }
      this->set(place, this->Heap[parent]);
      place = parent;
    }
    this->set(place, entry);
  }

  /** Removes the vertex with the smallest distance. */
  std::uint32_t take()
  {
    const std::uint32_t first = this->Heap[1].vertex;
    this->Places[first] = 0;
    const Entry last = this->Heap[this->Size--];
    if (this->Size > 0)
    {
      this->sink(last);
    }
    return first;
  }

private:
  struct Entry
  {
    std::uint32_t key;
    std::uint32_t vertex;
  };

  void set(std::uint32_t place, const Entry& entry)
  {
    this->Heap[place] = entry;
    this->Places[entry.vertex] = place;
  }

  /** Puts an entry in place of the first one. */
  void sink(const Entry& entry)
  {
    std::uint32_t place = 1;
    for (;;)
    {
      // The children of place 1 are 2 to 5.
      const std::uint32_t child = 4 * place - 2;
      if (child > this->Size)
      {
        break;
      }
      const Entry* const least =
        std::min_element(this->Heap + child, this->Heap + std::min(child + 4, this->Size + 1),
          [](const Entry& a, const Entry& b) { return a.key < b.key; });
      if (least->key >= entry.key)
      {
        break;
      }
      const auto next = static_cast<std::uint32_t>(least - this->Heap);
      this->set(place, *least);
      place = next;
    }
    this->set(place, entry);
  }

  Buffer Memory, PlaceMemory;
  Entry* Heap;           ///< from 1 on
  std::uint32_t* Places; ///< the place of each vertex in the heap; 0: not in it
  std::uint32_t Size = 0;
};

/**
 * Marches the front of a distance in the order of the distances (a *label-correcting* form of
 * Dijkstra's method and of fast marching, Tsitsiklis 1995, Sethian 1996): a vertex passes its
 * distance on to its cells, and does so again whenever a shorter path to it is found.
 *
 * Every update keeps the smaller distance, so that the window and the order of updates change the
 * result by no more than rounding and the tolerance.
 */
class March final : public ChunkMarch
{
public:
  March(ChunkedMesh& mesh, Pool& pool)
    : ChunkMarch(mesh, pool)
    , Queue(pool, std::min(mesh.plan.window(), mesh.vertices))
    , Sight(this->Window, pool)
    , Within(mesh.farthest())
  {
  }

  /** The bytes of a march over chunks with at most this many inner and crossing cells. */
  static std::int64_t bytes(const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells,
    std::int64_t crossingCells)
  {
    return MarchWindow::bytes(plan, vertices, innerCells, crossingCells) +
           MarchQueue::bytes(std::min(plan.window(), vertices)) +
           (plan.roots ? LineOfSight::bytes(std::min(plan.window(), vertices)) : 0);
  }

private:
  /** How often the vertices of the mesh may be taken on average before the tolerance grows. */
  static constexpr std::int64_t MostTaken = 100;

  /** Counts a vertex that is taken: polls now and then, and lets the tolerance grow if the march
   * would not end. */
  void count();

  void settle(std::int64_t first, std::int64_t last) override;
  /** Settles until its queue is empty. */
  template <int Corners>
  void settle(std::int64_t first, std::int64_t last);
  /** Passes the distance of vertex v on to the other corners of a triangle; the last element of
   * `others` is not used. */
  void passOn(std::uint32_t v, const std::array<std::uint32_t, 3>& others);
  /** The same for a tetrahedron. */
  void passOn(std::uint32_t v, const std::array<std::uint32_t, 4>& others);
  FrontCorner corner(std::uint32_t vertex) const;
  /** Whether `w` may be nearer to another point of the curve or surface of sources than to its
   * source `v`: it is, if the edge from v to w does not leave all edges of the curve at v behind.
   */
  template <int Corners>
  bool isBesideCurve(std::uint32_t v, std::uint32_t w) const;
  /** Offers the path from vertex `v` along an edge to vertex `w`. */
  template <int Corners>
  void offerEdge(std::uint32_t v, std::uint32_t w, double length);
  /** Offers the straight line to vertex `w` of a solid from what vertex `v` sees. */
  void offerLine(std::uint32_t v, std::uint32_t w);
  /** Whether a line from a root to w is short enough to be followed. */
  bool gains(std::uint32_t w, double distance, const FrontRoot& root) const;
  /** What a vertex sees; a source sees itself. */
  FrontRoot rootOf(std::uint32_t vertex) const;
  /** What all of these corners see; unknown if they see different roots. */
  template <std::size_t N>
  FrontRoot commonRoot(const std::array<std::uint32_t, N>& corners) const;
  /** No path through a facet is shorter than the line from what its corners see, from which
   * rounding takes much in cells almost without volume. */
  template <std::size_t N>
  void limit(std::uint32_t w, Arrival& arrival, const std::array<std::uint32_t, N>& corners) const;
  bool isOfRegion(std::uint32_t v) const { return (this->Window.flags()[v] & OfRegion) != 0; }
  /** Offers vertex `w` of a solid the straight line to its nearest source, if this leaves a cell
   * through the face opposite to w, and w sees that. */
  void offerNearest(std::uint32_t w, const std::array<std::uint32_t, 3>& face);
  /** What w sees by a path through a facet with these corners. */
  template <std::size_t N>
  FrontRoot rootThrough(
    std::uint32_t w, double distance, const std::array<std::uint32_t, N>& corners) const;
  /** Whether an arrival changes the distance or the kind of front at vertex `w`. */
  bool isNews(std::uint32_t w, const Arrival& arrival) const;
  /**
   * Offers vertex `w` a path through a facet with these corners. Its source is the source of the
   * corner nearest to the path. Returns false if the path does not count because the front has come
   * to one of the corners by way of w. Without this rule, in a strip of nearly flat triangles,
   * where each vertex lies between its neighbours, each would get about the mean of their
   * distances, down to 0 between two sources.
   */
  template <std::size_t N>
  bool offer(std::uint32_t w, Arrival arrival, const std::array<std::uint32_t, N>& corners);
  /** Takes note of an arrival that counts: its distance, its front, of a corner that it has passed,
   * and the facet. */
  void accept(std::uint32_t w, const Arrival& arrival, std::uint32_t passed,
    const std::array<std::uint32_t, 3>& via);
  /** Takes note of the direction of an arrival that counts, and of what w sees. */
  template <std::size_t N>
  void arrive(std::uint32_t w, const Arrival& arrival, const std::array<std::uint32_t, N>& corners);

  /** Whether the front has come to two vertices from the same source, so that they have one image
   * of it. */
  bool haveOneSource(std::uint32_t a, std::uint32_t b) const
  {
    return this->Window.frontSource(a) == this->Window.frontSource(b);
  }

  MarchQueue Queue;
  LineOfSight Sight;
  /** Smaller relative changes of a distance are dropped, since each would be passed on through the
   * whole mesh. */
  double Tolerance = 1e-7;
  double Within;          ///< ChunkedMesh::farthest()
  std::int64_t Taken = 0; ///< vertices since the tolerance grew
};

} // namespace smg
