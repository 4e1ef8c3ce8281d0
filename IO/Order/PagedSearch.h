// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Order/PageCache.h"
#include "IO/Order/SearchQueue.h"
#include "IO/Order/VertexPages.h"
#include "IO/Order/VisitedBits.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** A vertex that a breadth-first search begins from when it has come to a level. */
struct SearchSource
{
  std::uint32_t level;
  std::uint32_t rank;
};

/** What a search has seen. */
struct SearchResult
{
  std::int64_t vertices = 0;
  std::uint32_t last = 0; ///< rank of the last vertex reached
  std::uint32_t levels = 0;
  double meanQueue = 0;       ///< the mean window of the order that it gives
  std::int64_t peakQueue = 0; ///< the span of the order that it gives
};

/** Breadth-first searches over paged vertices. They throw Error, and Cancelled. */
class PagedSearch
{
public:
  /** The cache is for both kinds of search. All outlive the search. */
  PagedSearch(VertexPages& pages, PageCache& cache, Workspace& workspace, std::size_t queueBytes);

  /** Bytes of memory that a search takes beside the cache. */
  static std::int64_t memoryFor(const VertexPages& pages, std::size_t queueBytes);

  /**
   * Searches without leaving a trace, from sources in ascending order of levels.
   * @param levels the level of each vertex whose rank is a multiple of `stride`; NoIndex: not
   * reached. Left alone if empty.
   */
  SearchResult probe(std::span<const SearchSource> sources, std::span<std::uint32_t> levels = {},
    std::int64_t stride = 1);

  /**
   * Searches the vertices that have no place, gives them the next places and appends them to an
   * order that has the precision of the pages. The sources have no place yet.
   */
  SearchResult place(std::span<const SearchSource> sources, OrderedVertices& order);

  /** Number of connected components; vertices may have places or not. */
  std::int64_t components();

  /** Searches without a trace so far. */
  std::int64_t probes() const { return this->Probes; }

private:
  /** reach(rank) gives the queue a source, take(rank, level) the neighbours of a vertex. */
  template <class Reach, class Take>
  SearchResult run(std::span<const SearchSource> sources, Reach&& reach, Take&& take);
  template <class Real>
  SearchResult placeAs(std::span<const SearchSource> sources, OrderedVertices& order);
  /** Searches the vertices whose bits are not set. */
  template <class Seen>
  SearchResult visit(std::span<const SearchSource> sources, Seen&& seen);

  Workspace& Space;
  VertexPages& Pages;
  PageCache& Cache;
  SearchQueue Queue;
  VisitedBits Visited;
  std::int64_t Probes = 0;
  std::uint32_t Visits = 0; ///< of vertices, by all searches
};

} // namespace smg
