// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ExternalSort.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace smg::testing
{
namespace
{

TEST(ParallelSort, IsTheSortOfOneThread)
{
  for (const int threads : { 1, 2, 3, 8, 16 })
  {
    Workers workers(threads);
    for (const std::size_t count : { 0, 1, 1000, 40000, 300001 })
    {
      Random random(3);
      std::vector<std::uint64_t> numbers(count);
      for (std::size_t i = 0; i < count; ++i)
      {
        // Distinct, in random order with sorted stretches.
        numbers[i] = ((i % 1000 < 500 ? random.bits() : i) << 20) + i;
      }
      std::vector<std::uint64_t> expected = numbers;
      std::ranges::sort(expected);
      parallelSort(workers, numbers.data(), numbers.data() + count, std::less<std::uint64_t>());
      EXPECT_EQ(numbers, expected);
    }
  }
}

} // namespace
} // namespace smg::testing
