// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Schedule/Schedule.h"

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
Schedule stages(const std::vector<double>& costs, std::string& log)
{
  Schedule schedule;
  for (std::size_t s = 0; s < costs.size(); ++s)
  {
    schedule.add({ "stage", 0, costs[s], [s, &log](bool follows) {
                    log.push_back(static_cast<char>((follows ? 'a' : 'A') + static_cast<int>(s)));
                  } });
  }
  return schedule;
}

/** The chains into which the stages are cut, separated by bars. */
std::string cut(const std::vector<double>& costs, int chains)
{
  std::string log;
  Schedule schedule = stages(costs, log);
  schedule.cut(chains);
  EXPECT_LE(schedule.chains(), chains);
  for (int chain = 0; chain < schedule.chains(); ++chain)
  {
    log += chain > 0 ? "|" : "";
    schedule.run(chain);
  }
  return log;
}

} // namespace

TEST(Schedule, IsCutIntoChainsOfAboutTheSameCost)
{
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 1), "Abcd");
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 2), "Ab|Cd");
  EXPECT_EQ(cut({ 1, 1, 1, 1 }, 4), "A|B|C|D");
  EXPECT_EQ(cut({ 1, 1, 1, 5 }, 2), "Abc|D");
  EXPECT_EQ(cut({ 5, 1, 1, 1 }, 2), "A|Bcd");
  EXPECT_EQ(cut({ 1, 2, 2, 1, 0, 2 }, 3), "Ab|C|Def");
}

TEST(Schedule, HasNoMoreChainsThanStages)
{
  EXPECT_EQ(cut({ 1, 1, 1 }, 100), "A|B|C");
  EXPECT_EQ(cut({ 0, 0 }, 2), "Ab");
}

TEST(Schedule, AdvancesAllStagesInOrder)
{
  std::string log;
  Schedule schedule = stages({ 1, 1, 1 }, log);
  schedule.cut(3);
  schedule.advance();
  EXPECT_EQ(log, "abc");
}

TEST(Schedule, StepsOfAnyLengthDoNotOverflow)
{
  constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t nodes : { std::int64_t(1), Most / 2, Most / 2 + 1, Most })
  {
    EXPECT_EQ(Schedule::stepFor(1, nodes), nodes);
    EXPECT_GE(Schedule::stepFor(8, nodes), nodes);
  }
}

} // namespace smg::testing
