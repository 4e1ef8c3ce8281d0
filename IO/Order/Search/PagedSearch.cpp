// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/PagedSearch.h"

#include "IO/External/Relabelling.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

// Breadth-first search over vertices in pages, with a cache of pages, a bit per vertex and a queue
// that spills to disk.
//
// A search without a trace ("probe") reads adjacencies only. A placing search also gives each
// vertex its position when it is first seen; when a vertex is taken from the queue all its
// neighbours therefore have positions, and its final record can be written at once: the order needs
// no sort and no join afterwards.
//
// Vertices that are close in the search are close on the curve, so if the cache has room for the
// pages at the front, each page is loaded about once. The length of the queue while a vertex is
// taken is the window of the order there: its maximum is the span, its mean what a solver pays.

namespace smg
{

SearchQueue::SearchQueue(Workspace& workspace, std::size_t bytes)
  : Space(workspace)
  , Half(std::max<std::size_t>(16, bytes / 2 / sizeof(std::uint32_t)))
  , Front(workspace.pool(), this->Half * sizeof(std::uint32_t))
  , Back(workspace.pool(), this->Half * sizeof(std::uint32_t))
{
}

/** Nothing is in between: the back becomes the front. */
void SearchQueue::turn()
{
  std::swap(this->Front, this->Back);
  this->FrontBegin = 0;
  this->FrontEnd = std::exchange(this->BackEnd, 0);
}

/** Makes room at the back. If nothing waits before it, it becomes the front; otherwise it goes to
 * the file. */
void SearchQueue::spill()
{
  if (this->FrontBegin == this->FrontEnd && this->FileBegin == this->File.size())
  {
    this->turn();
    return;
  }
  if (!this->File.isOpen())
  {
    this->File.create(this->Space.folder());
  }
  this->File.append(this->Back.bytes());
  this->Space.traffic().bytesWritten += std::int64_t(this->Back.size());
  this->BackEnd = 0;
}

/** Makes the next values the front: from the file, which comes before the back, as long as it has
 * any. */
void SearchQueue::refill()
{
  if (this->FileBegin == this->File.size())
  {
    this->turn();
    return;
  }
  // spill() appends whole halves, so there is a full one to read.
  this->File.read(this->FileBegin, this->Front.bytes());
  this->FileBegin += std::int64_t(this->Front.size());
  this->Space.traffic().bytesRead += std::int64_t(this->Front.size());
  this->FrontBegin = 0;
  this->FrontEnd = this->Half;
  if (this->FileBegin == this->File.size())
  {
    // All has been read: the file is written from its beginning again, so that it stays short.
    this->FileBegin = 0;
    this->File.restart();
  }
}

void SearchQueue::clear()
{
  this->FrontBegin = this->FrontEnd = this->BackEnd = 0;
  this->Size = this->FileBegin = 0;
  this->File.restart();
}

namespace
{

constexpr std::uint32_t PolledVisits = std::uint32_t(1) << 16;

/** Tests without a division whether a 32-bit number is a multiple of a fixed one. */
class MultipleOf
{
public:
  explicit MultipleOf(std::int64_t divisor)
    // Lemire: n is a multiple of d if n * ceil(2^64 / d), modulo 2^64, is less than that factor.
    : Factor(~std::uint64_t(0) / static_cast<std::uint64_t>(divisor) + 1)
  {
  }
  bool operator()(std::uint32_t n) const { return n * this->Factor <= this->Factor - 1; }

private:
  std::uint64_t Factor;
};

/** Assigns positions to vertices as they are first seen, in their pages. */
class Placing
{
public:
  Placing(VertexPages& pages, PageCache& cache, SearchQueue& queue, std::int64_t firstPlace)
    : Pages(pages)
    , Cache(cache)
    , Queue(queue)
    , Next(static_cast<std::uint32_t>(firstPlace))
  {
  }

  /** The position of a vertex whose page is loaded; it gets the next one, and goes to the queue, if
   * it has none. */
  std::uint32_t placeOf(const PageView& view, std::uint32_t page, std::uint32_t rank)
  {
    std::uint32_t& place = view.places()[rank - view.firstRank()];
    if (place == NoIndex)
    {
      place = this->Next++;
      --this->Pages.unplaced(page);
      this->Cache.touch(page);
      this->Queue.push(rank);
    }
    return place;
  }
  std::uint32_t placeOf(std::uint32_t rank)
  {
    const std::uint32_t page = this->Pages.pageOf(rank);
    return this->placeOf(this->Cache.whole(page), page, rank);
  }

private:
  VertexPages& Pages;
  PageCache& Cache;
  SearchQueue& Queue;
  std::uint32_t Next;
};

} // namespace

PagedSearch::PagedSearch(
  VertexPages& pages, PageCache& cache, Workspace& workspace, std::size_t queueBytes)
  : Space(workspace)
  , Pages(pages)
  , Cache(cache)
  , QueueBytes(queueBytes)
  , Queue(workspace, queueBytes)
  , Visited(workspace, pages.vertices())
{
}

/** The search itself, level by level. When a level begins, the sources that start with it are added
 * to the queue; if the queue is empty before all sources have started, the level jumps to the
 * start of the next one. */
template <class Reach, class Take>
SearchResult PagedSearch::run(std::span<const SearchSource> sources, Reach&& reach, Take&& take)
{
  assert(std::ranges::is_sorted(sources, {}, &SearchSource::level) && this->Queue.size() == 0);
  SearchResult result;
  std::size_t nextSource = 0;
  std::uint32_t level = 0;
  std::int64_t leftOfLevel = 0;
  double sumOfQueues = 0;
  while (nextSource < sources.size() || this->Queue.size() > 0)
  {
    if (leftOfLevel == 0)
    {
      if (this->Queue.size() == 0)
      {
        level = std::max(level, sources[nextSource].level);
      }
      while (nextSource < sources.size() && sources[nextSource].level <= level)
      {
        reach(sources[nextSource++].rank);
      }
      // The queue has exactly the vertices of this level.
      leftOfLevel = this->Queue.size();
      // All sources of the level were reached before.
      if (leftOfLevel == 0)
      {
        continue;
      }
    }
    result.last = this->Queue.pop();
    take(result.last, level);
    ++result.vertices;
    if (++this->Visits % PolledVisits == 0)
    {
      this->Space.poll(); // pages in the cache are not read, which would poll
    }
    // What is in the queue after the vertex was taken is the window of the order at this vertex.
    sumOfQueues += static_cast<double>(this->Queue.size());
    result.peakQueue = std::max(result.peakQueue, this->Queue.size());
    if (--leftOfLevel == 0)
    {
      result.levels = ++level;
    }
  }
  result.meanQueue = result.vertices > 0 ? sumOfQueues / double(result.vertices) : 0;
  return result;
}

template <class Look, class Seen>
SearchResult PagedSearch::visit(std::span<const SearchSource> sources, Look&& look, Seen&& seen)
{
  const auto reach = [this](std::uint32_t rank)
  {
    if (this->Visited.set(rank))
    {
      this->Queue.push(rank);
    }
  };
  // Vertices of a page come in sequences, so the view of the last page is kept. Nothing else
  // requests pages, so it stays valid.
  PageView view(nullptr, 0, 0, 0);
  return this->run(sources, reach,
    [&](std::uint32_t rank, std::uint32_t level)
    {
      if (rank - view.firstRank() >= view.vertices())
      {
        view = look(this->Pages.pageOf(rank));
      }
      view.neighbours(rank - view.firstRank(), reach);
      seen(rank, level);
    });
}

/** A search without a trace, whose pages come from look(). Levels are recorded only at the
 * samples. */
template <class Look>
SearchResult PagedSearch::probeBy(std::span<const SearchSource> sources,
  std::span<std::uint32_t> levels, std::int64_t stride, Look&& look)
{
  this->Visited.clear();
  if (levels.empty())
  {
    return this->visit(sources, look, [](std::uint32_t, std::uint32_t) {});
  }
  std::ranges::fill(levels, NoIndex);
  const MultipleOf isSample(stride);
  return this->visit(sources, look,
    [&](std::uint32_t rank, std::uint32_t level)
    {
      if (isSample(rank))
      {
        levels[rank / std::uint32_t(stride)] = level;
      }
    });
}

SearchResult PagedSearch::probe(
  std::span<const SearchSource> sources, std::span<std::uint32_t> levels, std::int64_t stride)
{
  ++this->Probes;
  return this->probeBy(
    sources, levels, stride, [this](std::uint32_t page) { return this->Cache.adjacency(page); });
}

std::optional<SearchResult> PagedSearch::probeLoaded(
  std::span<const SearchSource> sources, std::span<std::uint32_t> levels, std::int64_t stride)
{
  // An exception ends the search from within, so that it needs no test for this at each vertex.
  struct IsNotLoaded
  {
  };
  try
  {
    const SearchResult result = this->probeBy(sources, levels, stride,
      [this](std::uint32_t page)
      {
        const std::optional<PageView> view = this->Cache.loaded(page);
        return view ? *view : throw IsNotLoaded();
      });
    ++this->Probes;
    return result;
  }
  catch (const IsNotLoaded&)
  {
    // The search was abandoned in the middle; the bits are cleared by the next one.
    this->Queue.clear();
    return std::nullopt;
  }
}

std::int64_t PagedSearch::components()
{
  this->Visited.clear();
  std::int64_t count = 0;
  for (std::int64_t rank = 0; rank < this->Pages.vertices(); ++count)
  {
    const SearchSource source = { 0, static_cast<std::uint32_t>(rank) };
    this->visit(
      { &source, 1 }, [this](std::uint32_t page) { return this->Cache.adjacency(page); },
      [](std::uint32_t, std::uint32_t) {});
    // The next component begins at the first vertex that no search has reached.
    rank = this->Visited.firstUnset(rank);
  }
  return count;
}

SearchResult PagedSearch::place(std::span<const SearchSource> sources, OrderedVertices& order)
{
  assert(order.doublePositions == this->Pages.doublePositions());
  return this->Pages.doublePositions() ? this->placeAs<double>(sources, order)
                                       : this->placeAs<float>(sources, order);
}

template <class Real>
SearchResult PagedSearch::placeAs(std::span<const SearchSource> sources, OrderedVertices& order)
{
  // Positions continue behind the earlier components.
  Placing placing(this->Pages, this->Cache, this->Queue, order.count);
  const SearchResult result = this->run(
    sources, [&](std::uint32_t rank) { placing.placeOf(rank); },
    [&](std::uint32_t rank, std::uint32_t)
    {
      const std::uint32_t page = this->Pages.pageOf(rank);
      const PageView view = this->Cache.whole(page);
      // The view of this page must stay valid while the pages of neighbours are loaded.
      this->Cache.pin(page);
      const std::uint32_t vertex = rank - view.firstRank();
      OrderedVertex<Real> record;
      record.reach = view.places()[vertex];
      assert(record.reach == order.count);
      view.neighbours(vertex,
        [&](std::uint32_t neighbour)
        {
          // Most neighbours are in the same page, which needs no request to the cache.
          const bool isHere = neighbour - view.firstRank() < view.vertices();
          record.reach = std::max(record.reach,
            isHere ? placing.placeOf(view, page, neighbour) : placing.placeOf(neighbour));
        });
      record.id = view.ids()[vertex];
      std::memcpy(
        record.position, view.position(vertex, sizeof record.position), sizeof record.position);
      // `reach` is complete: all neighbours have positions.
      order.records.put(0, record);
      ++order.count;
    });
  this->Cache.unpin();
  return result;
}

} // namespace smg
