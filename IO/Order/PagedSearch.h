// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Order/PageCache.h"
#include "IO/Order/VertexPages.h"

#include <cstdint>
#include <span>
#include <vector>

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
  double meanQueue = 0;
  std::int64_t peakQueue = 0; ///< the span of the order that it gives
};

/** Breadth-first searches over paged vertices. */
class PagedSearch
{
public:
  /** The cache is for both kinds of search. All outlive the search. */
  PagedSearch(VertexPages& pages, PageCache& cache, Workspace& workspace);

  /**
   * Searches without leaving a trace, from sources in ascending order of levels.
   * @param levels the level of each vertex whose rank is a multiple of `stride`; NoIndex: not
   * reached. Left alone if empty.
   */
  SearchResult probe(std::span<const SearchSource> sources, std::span<std::uint32_t> levels = {},
    std::int64_t stride = 1);

  /** Searches the vertices that have no place, gives them the next places and appends them. */
  SearchResult place(std::span<const SearchSource> sources, OrderedVertices& order);

private:
  // The rest is up to PagedSearch.cpp.
};

} // namespace smg
