// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Facets.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace smg::testing
{

TEST(OpenFacets, AreThoseOfOneCellInTheOrderOfTheFirst)
{
  // Few facets at some vertices, thousands at others, so that all kinds of lists occur.
  Pool pool(std::int64_t(1) << 26);
  OpenFacets open(pool);
  constexpr std::int64_t Vertices = 40;
  open.extend(Vertices);
  using Key = std::pair<std::int64_t, std::int64_t>;
  std::vector<std::map<Key, std::vector<std::int32_t>>> added(Vertices);
  std::vector<std::vector<Key>> order(Vertices);
  Random random(7);
  for (std::int32_t data = 0; data < 60000; ++data)
  {
    const std::int64_t low = random.below(Vertices);
    const Key key{ low + 1 + random.below(3 + low * low), low + 1 + random.below(3 + low) };
    std::vector<std::int32_t>& known = added[low][key];
    known.push_back(data);
    const std::int32_t expected = known.size() == 1   ? OpenFacets::Fresh
                                  : known.size() == 2 ? known[0]
                                                      : 0;
    ASSERT_EQ(open.add(low, key.first, key.second, data), expected) << data;
    if (known.size() == 1)
    {
      order[low].push_back(key);
    }
  }
  std::size_t longest = 0;
  for (std::int64_t low = 0; low < Vertices; ++low)
  {
    std::vector<std::tuple<std::int64_t, std::int64_t, std::int32_t>> expected, found;
    for (const Key& key : order[low])
    {
      if (added[low][key].size() == 1)
      {
        expected.emplace_back(key.first, key.second, added[low][key][0]);
      }
    }
    open.take(low, [&](std::int64_t middle, std::int64_t high, std::int32_t data)
      { found.emplace_back(middle, high, data); });
    EXPECT_EQ(found, expected);
    longest = std::max(longest, order[low].size());
    open.take(low, [](std::int64_t, std::int64_t, std::int32_t) { FAIL(); });
  }
  EXPECT_GT(longest, 1000);
}

TEST(OpenFacets, OfAHubAreReleasedWithIt)
{
  Pool pool(std::int64_t(1) << 26);
  OpenFacets open(pool);
  open.extend(2);
  std::int64_t after = 0;
  for (int round = 0; round < 3; ++round)
  {
    for (std::int64_t k = 2; k < 100000; ++k)
    {
      open.add(0, k, 0, 1);
    }
    std::int64_t facets = 0;
    open.take(0, [&](std::int64_t, std::int64_t, std::int32_t) { ++facets; });
    EXPECT_EQ(facets, 99998);
    EXPECT_TRUE(round == 0 || pool.used() == after);
    after = pool.used();
  }
}

} // namespace smg::testing
