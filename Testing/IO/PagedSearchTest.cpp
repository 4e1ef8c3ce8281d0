// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/PagedSearch.h"

#include "IO/External/Relabelling.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/InCorePages.h"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>

namespace smg::testing
{

namespace
{

/** Ranks instead of vertices, as in the pages. */
Neighbours alongRanks(const Neighbours& neighbours, std::span<const std::uint32_t> curve)
{
  std::vector<std::uint32_t> ranks(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    ranks[curve[i]] = static_cast<std::uint32_t>(i);
  }
  Neighbours result{ { 0 }, {} };
  for (const std::uint32_t vertex : curve)
  {
    for (const std::uint32_t other : neighbours[vertex])
    {
      result.all.push_back(ranks[other]);
    }
    result.begins.push_back(result.all.size());
  }
  return result;
}

/** A mesh in pages of 32 vertices. */
struct PagedCase
{
  explicit PagedCase(const IndexedTestMesh& mesh, int pageVertices = 32)
    : neighbours(neighboursOf(mesh))
    , ranks(alongRanks(this->neighbours, alongCurve(mesh.positions)))
    , paged(pagesOf(mesh, pageVertices, this->workspace))
  {
  }

  Workspace workspace{ {}, Workspace::MinMemory };
  Neighbours neighbours, ranks;
  PagedMesh paged;
};

TEST(PagedSearch, LevelsAreThoseInMemory)
{
  PagedCase box(shuffled(tetBox(9, 8, 7)));
  const auto count = static_cast<std::uint32_t>(box.ranks.vertices());
  const std::vector<SearchSource> sources = { { 0, 3 }, { 2, count - 1 }, { 2, 100 },
    { 5, count / 2 }, { 900, 7 } };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const SearchSource& source : sources)
  {
    pairs.emplace_back(source.rank, source.level);
  }
  const std::vector<std::uint32_t> expected = inCoreLevels(box.ranks, pairs);

  const std::int64_t least = PageCache::minBytes(box.paged.pages);
  for (const std::int64_t bytes : { least, 2 * least, PageCache::maxBytes(box.paged.pages) })
  {
    PageCache cache(box.paged.pages, box.workspace, bytes);
    PagedSearch search(box.paged.pages, cache, box.workspace, 4096);
    for (const std::uint32_t stride : { 1u, 3u, 7u, 64u })
    {
      std::vector<std::uint32_t> levels((count + stride - 1) / stride);
      const SearchResult result = search.probe(sources, levels, stride);
      EXPECT_EQ(result.vertices, count);
      EXPECT_EQ(result.levels, *std::ranges::max_element(expected) + 1);
      EXPECT_EQ(expected[result.last], result.levels - 1);
      for (std::size_t i = 0; i < levels.size(); ++i)
      {
        ASSERT_EQ(levels[i], expected[i * stride]) << i << " of stride " << stride;
      }
    }
  }
}

TEST(PagedSearch, ASourceThatBeginsWhenAllElseIsOver)
{
  PagedCase two(disjointUnion(grid(5, 5), grid(6, 6), { 100, 0, 0 }), 8);
  PageCache cache(two.paged.pages, two.workspace, PageCache::maxBytes(two.paged.pages));
  PagedSearch search(two.paged.pages, cache, two.workspace, 4096);
  const std::uint32_t last = 60;
  const std::vector<SearchSource> sources = { { 0, 0 }, { 1000, last } };
  std::vector<std::uint32_t> levels(61);
  EXPECT_EQ(search.probe(sources, levels).vertices, 61);
  EXPECT_EQ(levels[last], 1000u);
  EXPECT_EQ(search.probe({ sources.data(), 1 }, levels).vertices, 25);
  EXPECT_EQ(std::ranges::count(levels, NoIndex), 36);
}

/** What one thread finds, with any cache. */
TEST(PagedSearch, ProbesDoNotDependOnThreads)
{
  const std::vector<SearchSource> sources = { { 0, 5 }, { 3, 9000 }, { 40, 11 }, { 9999, 12 } };
  for (const IndexedTestMesh& mesh : { shuffled(torus(200, 150)), shuffled(tetBox(25, 24, 23)) })
  {
    std::vector<std::uint32_t> expected;
    SearchResult first;
    for (const int threads : { 1, 2, 3, 8, 16 })
    {
      Workspace workspace({}, 4 * Workspace::MinMemory, {}, 0, threads);
      PagedMesh paged = pagesOf(mesh, 32, workspace);
      const std::int64_t least = PageCache::minBytes(paged.pages);
      for (const std::int64_t bytes : { 4 * least, PageCache::maxBytes(paged.pages) })
      {
        PageCache cache(paged.pages, workspace, bytes);
        PagedSearch search(paged.pages, cache, workspace, 4096);
        std::vector<std::uint32_t> levels(static_cast<std::size_t>(mesh.vertices()));
        const SearchResult result = search.probe(sources, levels);
        EXPECT_EQ(search.components(), 1);
        if (threads == 1)
        {
          expected = levels;
          first = result;
        }
        EXPECT_EQ(levels, expected);
        EXPECT_EQ(result.vertices, mesh.vertices());
        EXPECT_EQ(result.last, first.last);
        EXPECT_EQ(result.levels, first.levels);
        EXPECT_EQ(result.meanQueue, first.meanQueue);
        EXPECT_EQ(result.peakQueue, first.peakQueue);
      }
    }
  }
}

/** The same order with any cache and queue, and the size that a probe predicted. */
TEST(PagedSearch, PlacesDoNotDependOnMemory)
{
  const IndexedTestMesh mesh = shuffled(torus(60, 40));
  ReadOrder first;
  for (const double share : { 0.0, 0.1, 0.3, 1.0 })
  {
    for (const std::size_t queueBytes : { std::size_t(128), std::size_t(1) << 16 })
    {
      PagedCase torus(mesh);
      VertexPages& pages = torus.paged.pages;
      const auto most = static_cast<double>(PageCache::maxBytes(pages));
      PageCache cache(
        pages, torus.workspace, std::max(PageCache::minBytes(pages), std::int64_t(share * most)));
      PagedSearch search(pages, cache, torus.workspace, queueBytes);
      const std::vector<SearchSource> sources = { { 0, 17 }, { 4, 1500 }, { 9, 700 } };
      const SearchResult probed = search.probe(sources);
      OrderedVertices order(torus.workspace);
      const SearchResult placed = search.place(sources, order);
      order.records.close();
      EXPECT_EQ(placed.vertices, 2400);
      EXPECT_EQ(order.count, 2400);
      EXPECT_EQ(placed.peakQueue, probed.peakQueue);
      EXPECT_DOUBLE_EQ(placed.meanQueue, probed.meanQueue);
      EXPECT_EQ(placed.last, probed.last);
      for (std::int64_t page = 0; page < pages.pages(); ++page)
      {
        EXPECT_EQ(pages.unplaced(page), 0u);
      }

      const ReadOrder read = readOrder(order);
      expectOrder(torus.neighbours, read, 2400);
      const OrderSize size = orderSize(torus.neighbours, read.ids);
      // A source enters the queue shortly before it enters the window.
      const auto later = static_cast<double>(sources.size());
      EXPECT_LE(size.span, placed.peakQueue);
      EXPECT_NEAR(double(size.span), double(placed.peakQueue), later);
      EXPECT_LE(size.meanWindow, placed.meanQueue);
      EXPECT_NEAR(size.meanWindow, placed.meanQueue, later / 100);
      for (std::size_t i = 0; i < read.positions.size(); ++i)
      {
        ASSERT_EQ(read.positions[i], mesh.positions[3 * read.ids[i / 3] + i % 3]);
      }
      first = first.ids.empty() ? read : first;
      EXPECT_EQ(read.ids, first.ids);
    }
  }
}

TEST(PagedSearch, LoadsEachPageOnceIfTheyFit)
{
  PagedCase ball(sphere(5), 64);
  PageCache cache(ball.paged.pages, ball.workspace, PageCache::maxBytes(ball.paged.pages));
  PagedSearch search(ball.paged.pages, cache, ball.workspace, 4096);
  const SearchSource source{ 0, 0 };
  search.probe({ &source, 1 });
  search.probe({ &source, 1 });
  EXPECT_EQ(cache.loads(), ball.paged.pages.pages());
  OrderedVertices order(ball.workspace);
  search.place({ &source, 1 }, order);
  EXPECT_EQ(cache.loads(), 2 * ball.paged.pages.pages());
}

TEST(PagedSearch, LoadsPagesAboutOnceIfTheFrontFits)
{
  PagedCase ball(sphere(6), 64);
  const std::int64_t bytes = ball.paged.pages.allBytes() / 3;
  PageCache cache(ball.paged.pages, ball.workspace, bytes);
  PagedSearch search(ball.paged.pages, cache, ball.workspace, 4096);
  const SearchSource source{ 0, 0 };
  OrderedVertices order(ball.workspace);
  search.place({ &source, 1 }, order);
  EXPECT_LT(double(cache.loads()), 1.1 * double(ball.paged.pages.pages()));
}

TEST(PagedSearch, CountsComponents)
{
  IndexedTestMesh mesh = grid(3, 3);
  for (int i = 1; i < 100; ++i)
  {
    mesh =
      disjointUnion(mesh, i % 3 == 0 ? grid(2, 2) : grid(2, 5), { 10.0 * i, 3.0 * (i % 7), 0 });
  }
  PagedCase many(shuffled(mesh));
  PageCache cache(many.paged.pages, many.workspace, PageCache::minBytes(many.paged.pages));
  PagedSearch search(many.paged.pages, cache, many.workspace, 4096);
  EXPECT_EQ(search.components(), 100);
  EXPECT_EQ(search.components(), inCoreComponents(many.neighbours));
}

/** A search that has loaded all or some of its pages before it is stopped. */
void expectCancelled(const IndexedTestMesh& mesh, bool allPagesFit)
{
  bool goesOn = true;
  Workspace workspace({}, Workspace::MinMemory, [&goesOn](double) { return goesOn; });
  PagedMesh paged = pagesOf(mesh, 64, workspace);
  PageCache cache(paged.pages, workspace,
    allPagesFit ? PageCache::maxBytes(paged.pages) : PageCache::minBytes(paged.pages));
  PagedSearch search(paged.pages, cache, workspace, 4096);
  const SearchSource source{ 0, 0 };
  EXPECT_EQ(search.probe({ &source, 1 }).vertices, mesh.vertices());
  const std::int64_t loads = cache.loads();
  goesOn = false;
  EXPECT_THROW(search.probe({ &source, 1 }), Cancelled);
  EXPECT_EQ(cache.loads() == loads, allPagesFit);
}

TEST(PagedSearch, CanBeCancelledWhilePagesAreRead)
{
  expectCancelled(grid(200, 200), false);
}

TEST(PagedSearch, CanBeCancelledThoughNoPageIsRead)
{
  expectCancelled(grid(300, 300), true);
}

TEST(PagedSearch, ACacheThatIsTooSmallSaysSo)
{
  PagedCase ball(sphere(3));
  expectError([&] { PageCache(ball.paged.pages, ball.workspace, 100); }, "memory limit");
}

TEST(SearchQueue, IsAQueueWhateverItsMemory)
{
  for (const std::size_t bytes : { 0, 1000, 100000 })
  {
    Workspace workspace({}, Workspace::MinMemory);
    SearchQueue queue(workspace, bytes);
    std::deque<std::uint32_t> expected;
    Random random(bytes);
    std::uint32_t next = 0;
    for (int round = 0; round < 200; ++round)
    {
      for (std::int64_t i = random.below(300); i > 0; --i)
      {
        queue.push(next);
        expected.push_back(next++);
      }
      for (std::int64_t i = random.below(round < 100 ? 200 : 400); i > 0 && !expected.empty(); --i)
      {
        ASSERT_EQ(queue.pop(), expected.front());
        expected.pop_front();
      }
      ASSERT_EQ(queue.size(), std::int64_t(expected.size()));
    }
  }
}

TEST(VisitedBits, AreClearedHoweverManyAreSet)
{
  Workspace workspace({}, Workspace::MinMemory);
  const std::int64_t count = 3000001;
  VisitedBits bits(workspace, count);
  for (const std::int64_t step : { 1000000, 1000, 64, 3 })
  {
    EXPECT_EQ(bits.firstUnset(0), 0);
    for (std::int64_t i = 0; i < count; i += step)
    {
      ASSERT_TRUE(bits.set(static_cast<std::uint32_t>(i)));
      ASSERT_FALSE(bits.set(static_cast<std::uint32_t>(i)));
    }
    EXPECT_EQ(bits.firstUnset(0), 1);
    bits.clear();
    for (std::int64_t i = 0; i < count; ++i)
    {
      ASSERT_TRUE(bits.set(static_cast<std::uint32_t>(i)));
    }
    EXPECT_EQ(bits.firstUnset(0), count);
    bits.clear();
  }
}

} // namespace

} // namespace smg::testing
