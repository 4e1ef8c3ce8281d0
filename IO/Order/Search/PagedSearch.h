// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/PageCache.h"
#include "IO/Order/Pages/VertexPages.h"
#include "Solver/Files/CheckedFile.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>

namespace smg
{

/** A first-in first-out queue of any length in a fixed amount of memory: its front and its back are
 * in memory, what is between them in a scratch file. */
class SearchQueue
{
public:
  /** The workspace must outlive the queue. */
  SearchQueue(Workspace& workspace, std::size_t bytes);

  std::int64_t size() const { return this->Size; }

  /** Throws Error if the disk is full. */
  void push(std::uint32_t value)
  {
    if (this->BackEnd == this->Half)
    {
      this->spill();
    }
    reinterpret_cast<std::uint32_t*>(this->Back.data())[this->BackEnd++] = value;
    ++this->Size;
  }
  /** Of a non-empty queue. */
  std::uint32_t pop()
  {
    if (this->FrontBegin == this->FrontEnd)
    {
      this->refill();
    }
    --this->Size;
    return reinterpret_cast<const std::uint32_t*>(this->Front.data())[this->FrontBegin++];
  }

  void clear();

private:
  void spill();
  void refill();
  void turn();

  Workspace& Space;
  std::size_t Half; ///< values in a half of the memory
  Buffer Front, Back;
  std::size_t FrontBegin = 0, FrontEnd = 0, BackEnd = 0;
  std::int64_t Size = 0;
  CheckedFile File;
  std::int64_t FileBegin = 0; ///< of the values in the file that were not read
};

/** A bit for each rank. Clearing is cheap if few bits are set: the words that have some are
 * remembered. */
class VisitedBits
{
public:
  VisitedBits(Workspace& workspace, std::int64_t count)
    : Count(count)
    , Bits(workspace.pool(), bytesFor(count))
    , Changed(workspace)
  {
    this->Changed.reserve(MaxRemembered);
    std::memset(this->Bits.data(), 0, this->Bits.size());
  }

  static std::size_t bytesFor(std::int64_t count) { return std::size_t(count + 63) / 64 * 8; }

  /** Sets a bit; returns whether it was not set before. */
  bool set(std::uint32_t rank)
  {
    std::uint64_t& word = this->words()[rank / 64];
    const std::uint64_t bit = std::uint64_t(1) << (rank % 64);
    if (word & bit)
    {
      return false;
    }
    if (word == 0)
    {
      this->remember(rank / 64);
    }
    word |= bit;
    return true;
  }

  bool isSet(std::uint32_t rank) const
  {
    return (this->words()[rank / 64] >> (rank % 64) & 1) != 0;
  }

  void clear()
  {
    if (this->Changed.size() == MaxRemembered)
    {
      std::memset(this->Bits.data(), 0, this->Bits.size());
    }
    for (const std::uint32_t word : this->Changed.all())
    {
      this->words()[word] = 0;
    }
    this->Changed.clear();
  }

  /** The first rank from `rank` on whose bit is not set; the number of ranks if there is none. */
  std::int64_t firstUnset(std::int64_t rank) const
  {
    while (rank < this->Count)
    {
      const std::uint64_t unset = ~this->words()[rank / 64] >> (rank % 64);
      if (unset != 0)
      {
        return std::min(this->Count, rank + std::countr_zero(unset));
      }
      rank = (rank / 64 + 1) * 64;
    }
    return this->Count;
  }

private:
  static constexpr std::size_t MaxRemembered = 16384;

  std::uint64_t* words() const { return reinterpret_cast<std::uint64_t*>(this->Bits.data()); }
  void remember(std::uint32_t word)
  {
    if (this->Changed.size() < MaxRemembered)
    {
      this->Changed.push(word);
    }
  }

  std::int64_t Count;
  Buffer Bits;
  /** Words with bits set, up to a limit. */
  GrowingArray<std::uint32_t> Changed;
};

/** A source of a breadth-first search: the vertex is added when the search begins this level. */
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

/** Breadth-first searches over paged vertices, one after another. They throw Error, and
 * Cancelled. */
class PagedSearch
{
public:
  /** The cache serves both kinds of search. All arguments must outlive the search. */
  PagedSearch(VertexPages& pages, PageCache& cache, Workspace& workspace, std::size_t queueBytes);

  /** Bytes of memory of a search in addition to the cache. */
  static std::int64_t memoryFor(const VertexPages& pages, std::size_t queueBytes)
  {
    return std::int64_t(VisitedBits::bytesFor(pages.vertices()) + queueBytes) + (128 << 10);
  }
  /** Another search in the same cache: see probeLoaded(). */
  std::unique_ptr<PagedSearch> another() const
  {
    return std::make_unique<PagedSearch>(this->Pages, this->Cache, this->Space, this->QueueBytes);
  }

  /**
   * Searches without changing anything, from sources in ascending order of levels.
   * @param levels set to the level of each vertex whose rank is a multiple of `stride`, or to
   * NoIndex if it was not reached; nothing is recorded if the span is empty
   */
  SearchResult probe(std::span<const SearchSource> sources, std::span<std::uint32_t> levels = {},
    std::int64_t stride = 1);
  /** The same, for several searches on different threads while nothing else uses the cache. No
   * result if the cache lacks a page. */
  std::optional<SearchResult> probeLoaded(std::span<const SearchSource> sources,
    std::span<std::uint32_t> levels = {}, std::int64_t stride = 1);

  /** Whether the last probe reached a vertex. */
  bool reached(std::uint32_t rank) const { return this->Visited.isSet(rank); }

  /** Searches the vertices without a position, gives them the next positions and appends them to an
   * order, in the precision of the pages. The sources must not have positions. */
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
  std::uint32_t Visits = 0; ///< of vertices, by all searches of this object
};

} // namespace smg
