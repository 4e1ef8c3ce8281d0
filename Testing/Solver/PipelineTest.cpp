// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/Pipeline.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** The stages a, b, ... of these costs, which append their names to `log`, in upper case if they do
 * not follow the stage before them. */
Pipeline stages(const std::vector<double>& costs, std::string& log)
{
  Pipeline pipeline;
  for (std::size_t s = 0; s < costs.size(); ++s)
  {
    pipeline.add(costs[s], [s, &log](bool follows)
      { log.push_back(static_cast<char>((follows ? 'a' : 'A') + static_cast<int>(s))); });
  }
  return pipeline;
}

/** The chains into which the stages are cut, separated by bars. */
std::string cut(const std::vector<double>& costs, int chains)
{
  std::string log;
  Pipeline pipeline = stages(costs, log);
  pipeline.cut(chains);
  EXPECT_LE(pipeline.chains(), chains);
  for (int chain = 0; chain < pipeline.chains(); ++chain)
  {
    log += chain > 0 ? "|" : "";
    pipeline.advance(chain);
  }
  return log;
}

} // namespace

TEST(Pipeline, IsCutIntoChainsOfAboutTheSameCost)
{
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 1), "Abcd");
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 2), "Ab|Cd");
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 4), "A|B|C|D");
  EXPECT_EQ(cut({ 1, 1, 1, 5 }, 2), "Abc|D");
  EXPECT_EQ(cut({ 5, 1, 1, 1 }, 2), "A|Bcd");
  EXPECT_EQ(cut({ 1, 2, 2, 1, 0, 2 }, 3), "Ab|C|Def");
}

TEST(Pipeline, HasNoMoreChainsThanStages)
{
  EXPECT_EQ(cut({ 1, 1, 1 }, 100), "A|B|C");
  EXPECT_EQ(cut({ 0, 0 }, 2), "Ab");
}

TEST(Pipeline, AdvancesAllStagesInOrder)
{
  std::string log;
  Pipeline pipeline = stages({ 1, 1, 1 }, log);
  pipeline.cut(3);
  pipeline.advance();
  EXPECT_EQ(log, "abc");
}

TEST(Pipeline, StepsOfAnyLengthDoNotOverflow)
{
  constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t nodes : { std::int64_t(1), Most / 2, Most / 2 + 1, Most })
  {
    EXPECT_EQ(Pipeline::stepFor(1, nodes), nodes);
    EXPECT_GE(Pipeline::stepFor(8, nodes), nodes);
  }
}

} // namespace smg::testing
