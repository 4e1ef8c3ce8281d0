// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Schedule/Schedule.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{
namespace
{

std::vector<int> placesOf(const LongestTaskFirst& order)
{
  std::vector<int> tasks;
  for (int place = 0; place < order.tasks(); ++place)
  {
    tasks.push_back(order[place]);
  }
  return tasks;
}

} // namespace

TEST(LongestTaskFirst, TasksAreSortedByTheirTimesInAllSteps)
{
  LongestTaskFirst order(5);
  EXPECT_EQ(placesOf(order), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  order.add(3, 2.0);
  order.add(1, 1.0);
  order.add(4, 1.0);
  order.sort();
  EXPECT_EQ(placesOf(order), (std::vector<int>{ 0, 3, 1, 4, 2 }));
  order.add(2, 0.5);
  order.add(4, 1.5);
  order.sort();
  EXPECT_EQ(placesOf(order), (std::vector<int>{ 0, 4, 3, 1, 2 }));
}

TEST(LongestTaskFirst, TheFirstTaskStaysTheFirst)
{
  LongestTaskFirst order(2);
  order.add(1, 1.0);
  order.sort();
  EXPECT_EQ(placesOf(order), (std::vector<int>{ 0, 1 }));
}

} // namespace smg::testing
