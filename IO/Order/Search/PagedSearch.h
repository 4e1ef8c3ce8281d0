// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/PageCache.h"
#include "IO/Order/Pages/VertexPages.h"
#include "IO/Order/Search/SearchQueue.h"
#include "IO/Order/Search/VisitedBits.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace smg
{

/** A vertex from which a breadth-first search starts when it has reached a level. */
struct SearchSource
{
  std::uint32_t level;
  std::uint32_t rank;
};

/** The result of a search. */
struct SearchResult
{
  std::int64_t vertices = 0;
  std::uint32_t last = 0; ///< rank of the last vertex reached
  std::uint32_t levels = 0;
  double meanQueue = 0;       ///< the mean window of the resulting order
  std::int64_t peakQueue = 0; ///< the span of the resulting order
};

/** Breadth-first searches over paged vertices, one at a time. They throw Error, and Cancelled. */
class PagedSearch
{
public:
  /** The cache is for both kinds of search. All arguments must outlive the search. */
  PagedSearch(VertexPages& pages, PageCache& cache, Workspace& workspace, std::size_t queueBytes);

  /** Bytes of memory of a search in addition to the cache. */
  static std::int64_t memoryFor(const VertexPages& pages, std::size_t queueBytes);
  /** Another search in the same cache: see probeLoaded(). */
  std::unique_ptr<PagedSearch> another() const
  {
    return std::make_unique<PagedSearch>(this->Pages, this->Cache, this->Space, this->QueueBytes);
  }

  /**
   * Searches without leaving a trace, from sources in ascending order of levels.
   * @param levels the level of each vertex whose rank is a multiple of `stride`; NoIndex: not
   * reached. Left alone if empty.
   */
  SearchResult probe(std::span<const SearchSource> sources, std::span<std::uint32_t> levels = {},
    std::int64_t stride = 1);
  /** The same while other searches call it on other threads, but nothing else uses the cache; no
   * result if that lacks a page. */
  std::optional<SearchResult> probeLoaded(std::span<const SearchSource> sources,
    std::span<std::uint32_t> levels = {}, std::int64_t stride = 1);

  /** Whether the last search without a trace reached a vertex. */
  bool reached(std::uint32_t rank) const { return this->Visited.isSet(rank); }

  /** Searches the vertices without a position, assigns the next positions and appends them to an
   * order with the precision of the pages. The sources must not have a position yet. */
  SearchResult place(std::span<const SearchSource> sources, OrderedVertices& order);

  /** The number of connected components; vertices may have positions or not. */
  std::int64_t components();

  /** The number of searches without a trace so far. */
  std::int64_t probes() const { return this->Probes; }

private:
  /** reach(rank) appends a source to the queue, take(rank, level) the neighbours of a vertex. */
  template <class Reach, class Take>
  SearchResult run(std::span<const SearchSource> sources, Reach&& reach, Take&& take);
  template <class Real>
  SearchResult placeAs(std::span<const SearchSource> sources, OrderedVertices& order);
  /** Searches the vertices whose bits are not set. look(page) returns its view. */
  template <class Look, class Seen>
  SearchResult visit(std::span<const SearchSource> sources, Look&& look, Seen&& seen);
  template <class Look>
  SearchResult probeBy(std::span<const SearchSource> sources, std::span<std::uint32_t> levels,
    std::int64_t stride, Look&& look);

  Workspace& Space;
  VertexPages& Pages;
  PageCache& Cache;
  std::size_t QueueBytes;
  SearchQueue Queue;
  VisitedBits Visited;
  std::int64_t Probes = 0;
  std::uint32_t Visits = 0; ///< of vertices, by all searches
};

} // namespace smg
