// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SearchPlan.h"

#include "IO/Order/Search/SourcePlan.h"
#include "Testing/Support/InCorePages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg::testing
{

namespace
{

/** A star: arms of `length` samples at the distances 1, 2 ... from its centre. */
SourceDistances starDistances(Workspace& workspace, int arms, int length)
{
  SourceDistances distances(workspace, std::size_t(arms * length), std::size_t(arms));
  for (int end = 0; end < arms; ++end)
  {
    std::int32_t* to = distances.add();
    for (int arm = 0; arm < arms; ++arm)
    {
      for (int i = 1; i <= length; ++i)
      {
        *to++ = arm == end ? length - i : length + i;
      }
    }
  }
  return distances;
}

TEST(SourcePlan, OneEndOfAPathIsEnough)
{
  Workspace workspace({}, Workspace::MinMemory);
  const SourceDistances path = starDistances(workspace, 2, 1000);
  const SourcePlan plan = planSources(path, 2000, workspace).front();
  ASSERT_EQ(plan.sources.size(), 1u);
  EXPECT_EQ(plan.sources[0].level, 0);
  EXPECT_NEAR(plan.cost, 1, 0.1);
}

/** The arms one after another would be best; starting at several ends is better than at one. */
TEST(SourcePlan, ArmsOfAStarAreSearchedTwoAfterTwo)
{
  Workspace workspace({}, Workspace::MinMemory);
  const SourceDistances star = starDistances(workspace, 4, 1000);
  const SourcePlan plan = planSources(star, 400000, workspace).front();
  // From one end: a level has 100 vertices on the first arm, 300 on the others.
  const double single = searchCost(100 * 0.25 + 300 * 0.75, 300);
  EXPECT_GE(plan.sources.size(), 2u);
  EXPECT_LT(plan.cost, 0.85 * single);
  EXPECT_EQ(std::ranges::min(plan.sources, {}, &PlannedSource::level).level, 0);
}

/** All samples have the last level of the last bin, which single precision rounds up. */
TEST(SourcePlan, LevelsAreCountedHoweverManyThereAre)
{
  Workspace workspace({}, Workspace::MinMemory);
  constexpr std::size_t samples = 100;
  SourceDistances distances(workspace, samples, 1);
  std::fill_n(distances.add(), samples, 44999999);
  // All are in the last of 150 bins of 300000 levels, which counts fully for the mean, and a
  // quarter for the peak, as seen from the bin before it.
  const double window = 60000000.0 / 300000;
  EXPECT_NEAR(
    planSources(distances, 60000000, workspace).front().cost, searchCost(window, window / 4), 1e-6);
}

TEST(SourcePlan, IsDetermined)
{
  Workspace workspace({}, Workspace::MinMemory);
  const SourceDistances star = starDistances(workspace, 5, 300);
  const SourcePlan a = planSources(star, 1500, workspace).front();
  const SourcePlan b = planSources(star, 1500, workspace).front();
  ASSERT_EQ(a.sources.size(), b.sources.size());
  for (std::size_t i = 0; i < a.sources.size(); ++i)
  {
    EXPECT_EQ(a.sources[i].candidate, b.sources[i].candidate);
    EXPECT_EQ(a.sources[i].level, b.sources[i].level);
  }
}

TEST(AxisEnds, OfABox)
{
  // A line along (1, 2, 2), and a shorter one across.
  std::vector<float> points;
  std::vector<std::uint32_t> chosen;
  for (int i = -500; i <= 500; ++i)
  {
    for (int j = -20; j <= 20; ++j)
    {
      const auto t = float(i), s = float(j) * 5;
      points.insert(points.end(), { t - 2 * s, 2 * t + 2 * s, 2 * t - s });
      if (points.size() % 2 == 1)
      {
        chosen.push_back(std::uint32_t(points.size() / 3 - 1));
      }
    }
  }
  const auto ends = axisEnds(points, chosen);
  ASSERT_EQ(ends.size(), 4u);
  std::vector<double> along;
  for (const auto& end : ends)
  {
    ASSERT_GE(end.size(), 2u);
    double sum = 0;
    for (const std::uint32_t i : end)
    {
      EXPECT_TRUE(std::ranges::binary_search(chosen, i));
      sum += (points[3 * i] + 2 * points[3 * i + 1] + 2 * points[3 * i + 2]) / 9;
    }
    along.push_back(sum / double(end.size()));
  }
  // The ends of the long axis, in any order; those of the short axis share its middle.
  EXPECT_GT(std::abs(along[0] - along[1]), 970);
  EXPECT_LT(std::abs(along[2]), 20);
  EXPECT_LT(std::abs(along[3]), 20);
}

TEST(AxisEnds, OfPointsWithoutExtent)
{
  const std::vector<std::uint32_t> chosen = { 0, 1, 2 };
  EXPECT_TRUE(axisEnds(std::vector<float>(9, 3.0f), chosen).empty());
  const float huge = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(axisEnds(std::vector<float>{ 0, 0, 0, huge, 0, 0, 1, 1, 1 }, chosen).empty());
  EXPECT_EQ(axisEnds(std::vector<float>{ 0, 0, 0, 0, 0, 0, 5, 0, 0 }, chosen).size(), 1u);
}

/** Four arms of triangles around a middle. */
IndexedTestMesh cross(int length, int width)
{
  IndexedTestMesh mesh = grid(2 * length, 2 * length);
  const auto isIn = [&](std::int64_t vertex)
  {
    const auto x = vertex % (2 * length) - length, y = vertex / (2 * length) - length;
    return std::min(std::abs(x), std::abs(y)) <= width / 2;
  };
  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    if (isIn(mesh.corners[i]) && isIn(mesh.corners[i + 1]) && isIn(mesh.corners[i + 2]))
    {
      corners.insert(corners.end(), mesh.corners.begin() + std::ptrdiff_t(i),
        mesh.corners.begin() + std::ptrdiff_t(i) + 3);
    }
  }
  mesh.corners = corners;
  return mesh;
}

struct Planned
{
  explicit Planned(const IndexedTestMesh& mesh, int landmarks = 4)
    : neighbours(neighboursOf(mesh))
    , paged(this->pages(mesh))
    , cache(this->paged.pages, this->workspace, PageCache::maxBytes(this->paged.pages))
    , search(this->paged.pages, this->cache, this->workspace, 1 << 16)
  {
    const SearchSource first{ 0, 0 };
    const std::uint32_t end = this->search.probe({ &first, 1 }).last;
    this->sources = planSearch(this->search, this->paged, this->workspace, landmarks, end);
    const SearchSource sweep{ 0, end };
    this->swept = this->search.probe({ &sweep, 1 });
    this->planned = this->search.probe(this->sources);
  }
  PagedMesh pages(const IndexedTestMesh& mesh)
  {
    std::vector<std::uint32_t> curve = alongCurve(mesh.positions);
    std::erase_if(curve, [this](std::uint32_t vertex) { return this->neighbours[vertex].empty(); });
    return pagesOf(this->neighbours, mesh.positions, curve, 64, true, this->workspace);
  }

  Workspace workspace{ {}, Workspace::MinMemory };
  Neighbours neighbours;
  PagedMesh paged;
  PageCache cache;
  PagedSearch search;
  std::vector<SearchSource> sources;
  SearchResult swept, planned;
};

double costOf(const SearchResult& result)
{
  return searchCost(result.meanQueue, double(result.peakQueue));
}

TEST(SearchPlan, ACrossIsSearchedFromSeveralEnds)
{
  const Planned cross(testing::cross(150, 20));
  EXPECT_GE(cross.sources.size(), 2u);
  EXPECT_EQ(cross.planned.vertices, cross.swept.vertices);
  EXPECT_LT(costOf(cross.planned), 0.85 * costOf(cross.swept));
}

TEST(SearchPlan, IsNeverWorseThanADoubleSweep)
{
  for (const IndexedTestMesh& mesh : { grid(100, 100), grid(2, 3000), torus(200, 50), sphere(5),
         tetBox(12, 13, 14), grid(3, 3), tetBox(2, 2, 2) })
  {
    const Planned planned(shuffled(mesh));
    EXPECT_LE(costOf(planned.planned), costOf(planned.swept));
    EXPECT_EQ(planned.planned.vertices, mesh.vertices());
    EXPECT_TRUE(std::ranges::is_sorted(planned.sources, {}, &SearchSource::level));
  }
}

TEST(SearchPlan, TakesAnyNumberOfLandmarks)
{
  for (const int landmarks : { 1, 2, 3, 8 })
  {
    const Planned planned(torus(90, 40), landmarks);
    EXPECT_LE(costOf(planned.planned), costOf(planned.swept));
  }
}

TEST(SearchPlan, StaysInItsComponent)
{
  const Planned planned(disjointUnion(cross(60, 8), grid(50, 50), { 1000, 0, 0 }));
  EXPECT_LT(planned.planned.vertices, std::int64_t(planned.paged.pages.vertices()) - 2000);
}

} // namespace

} // namespace smg::testing
