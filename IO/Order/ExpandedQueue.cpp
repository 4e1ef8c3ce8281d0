// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/ExpandedQueue.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

namespace smg
{

namespace
{

/** Vertices of a stretch; fewer than the least are not worth another thread. */
constexpr std::int64_t LeastStretch = 64, MostStretch = 512;
/** Typical bytes of a stretch. */
constexpr std::int64_t StretchBytes = std::int64_t(24) << 10;

int stretches(const Workers& workers)
{
  return std::min(2 * workers.threads(), 32);
}

} // namespace

ExpandedQueue::ExpandedQueue(SearchQueue& queue, VertexPages& pages, PageCache& cache,
  const VisitedBits& visited, Workspace& workspace)
  : Queue(queue)
  , Pages(pages)
  , Cache(cache)
  , Visited(visited)
  , Reserved(workspace.pool(), bytes(workspace.workers()))
  , Threads(workspace.workers().threads())
  , Jobs(
      workspace.workers(), static_cast<std::size_t>(stretches(workspace.workers())),
      [this](Stretch& stretch) { this->expand(stretch); },
      [this](Stretch& stretch) { std::swap(this->Current, stretch); })
{
}

std::int64_t ExpandedQueue::bytes(const Workers& workers)
{
  return workers.threads() > 1 ? (stretches(workers) + 1) * StretchBytes : 0;
}

/** Submits what is in the queue, and takes the next stretch. */
void ExpandedQueue::advance()
{
  const std::int64_t share =
    std::clamp(this->size() / (2 * this->Threads + 1), LeastStretch, MostStretch);
  this->At = this->Begin = this->End = 0;
  const bool isShort = this->Queue.size() <= LeastStretch;
  if (this->Jobs.size() == 0 && isShort)
  {
    this->fill(this->Current, this->Queue.size());
    this->expand(this->Current);
    return;
  }
  const auto most = static_cast<std::size_t>(stretches(this->Jobs.workers()));
  while (this->Jobs.size() < most && this->Queue.size() >= (this->Jobs.size() == 0 ? 1 : share))
  {
    this->fill(this->Jobs.next(), std::min(share, this->Queue.size()));
    this->Jobs.submit();
  }
  this->Jobs.takeOldest();
}

void ExpandedQueue::fill(Stretch& stretch, std::int64_t count)
{
  stretch.ranks.resize(static_cast<std::size_t>(count));
  for (std::uint32_t& rank : stretch.ranks)
  {
    rank = this->Queue.pop();
  }
  this->Ahead += count;
}

void ExpandedQueue::expand(Stretch& stretch)
{
  stretch.ends.clear();
  stretch.candidates.clear();
  std::shared_lock lock(this->Loading);
  std::optional<PageView> view;
  for (const std::uint32_t rank : stretch.ranks)
  {
    // Vertices of a page come in sequences.
    if (!view || rank - view->firstRank() >= view->vertices())
    {
      const std::uint32_t page = this->Pages.pageOf(rank);
      view = this->Cache.loaded(page);
      if (!view)
      {
        lock.unlock();
        {
          const std::lock_guard alone(this->Loading);
          this->expand(stretch, rank, this->Cache.adjacency(page));
        }
        lock.lock();
        continue;
      }
    }
    this->expand(stretch, rank, *view);
  }
}

void ExpandedQueue::expand(Stretch& stretch, std::uint32_t rank, const PageView& view) const
{
  view.neighbours(rank - view.firstRank(),
    [&](std::uint32_t neighbour)
    {
      if (!this->Visited.has(neighbour))
      {
        stretch.candidates.push_back(neighbour);
      }
    });
  stretch.ends.push_back(stretch.candidates.size());
}

} // namespace smg
