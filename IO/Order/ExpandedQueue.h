// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/PageCache.h"
#include "IO/Order/SearchQueue.h"
#include "IO/Order/VisitedBits.h"
#include "Solver/Storage/OrderedJobs.h"
#include "Solver/Storage/Reservation.h"

#include <cstddef>
#include <cstdint>
#include <shared_mutex>
#include <span>
#include <vector>

namespace smg
{

/**
 * The queue of a breadth-first search whose vertices are looked up ahead, on several threads: pop()
 * gives a vertex with those of its neighbours that had not been visited when it was looked up. The
 * owner tests these again, in the order of the queue. So the search is exactly that of one thread,
 * which, however, need not decode the pages.
 *
 * Threads share the pages in the cache; one that needs another page loads it while no other reads.
 */
class ExpandedQueue
{
public:
  /** The arguments must outlive it. While it is not empty, the cache is for it alone. */
  ExpandedQueue(SearchQueue& queue, VertexPages& pages, PageCache& cache,
    const VisitedBits& visited, Workspace& workspace);

  /** Bytes of its memory. */
  static std::int64_t bytes(const Workers& workers);

  std::int64_t size() const { return this->Queue.size() + this->Ahead; }
  void push(std::uint32_t rank) { this->Queue.push(rank); }
  /** Of a non-empty queue. */
  std::uint32_t pop()
  {
    if (this->At == this->Current.ranks.size())
    {
      this->advance();
    }
    --this->Ahead;
    this->Begin = this->End;
    this->End = this->Current.ends[this->At];
    return this->Current.ranks[this->At++];
  }
  /** Neighbours of the last vertex: all that were not visited before it was taken, perhaps more. */
  std::span<const std::uint32_t> candidates() const
  {
    return std::span(this->Current.candidates).subspan(this->Begin, this->End - this->Begin);
  }

private:
  /** Consecutive vertices of the queue. */
  struct Stretch
  {
    std::vector<std::uint32_t> ranks;
    std::vector<std::size_t> ends; ///< of the candidates of each
    std::vector<std::uint32_t> candidates;
  };

  void advance();
  void fill(Stretch& stretch, std::int64_t count);
  void expand(Stretch& stretch);
  void expand(Stretch& stretch, std::uint32_t rank, const PageView& view) const;

  SearchQueue& Queue;
  VertexPages& Pages;
  PageCache& Cache;
  const VisitedBits& Visited;
  Reservation Reserved;
  const int Threads;
  std::shared_mutex Loading; ///< held alone by a thread that loads a page
  Stretch Current;           ///< being delivered
  std::size_t At = 0, Begin = 0, End = 0;
  std::int64_t Ahead = 0; ///< vertices that left the queue and were not delivered
  OrderedJobs<Stretch> Jobs;
};

} // namespace smg
