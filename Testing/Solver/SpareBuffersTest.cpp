// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Buffer.h"

#include <gtest/gtest.h>

#include <utility>

namespace smg::testing
{

TEST(SpareBuffers, AreUsedAgain)
{
  Pool pool(10000);
  SpareBuffers buffers(pool);
  Buffer first = buffers.take(1000);
  const std::byte* place = first.data();
  EXPECT_EQ(pool.used(), 1024);
  buffers.give(std::move(first));
  const Buffer second = buffers.take(500);
  EXPECT_EQ(second.data(), place);
  EXPECT_EQ(second.size(), 500U);
  EXPECT_EQ(pool.used(), 1024);
}

TEST(SpareBuffers, ReplaceOneThatIsTooSmallByOneWithRoom)
{
  Pool pool(10000);
  SpareBuffers buffers(pool);
  buffers.give(buffers.take(64));
  const Buffer larger = buffers.take(800);
  EXPECT_EQ(larger.size(), 800U);
  EXPECT_GE(larger.capacity(), 900U);
  EXPECT_EQ(pool.used(), static_cast<std::int64_t>(larger.capacity()));
}

TEST(SpareBuffers, GiveOthersAtMostSoMany)
{
  Pool pool(10000);
  SpareBuffers some(pool), others(pool);
  for (int i = 0; i < 5; ++i)
  {
    some.give(Buffer(pool, 64));
  }
  others.give(Buffer(pool, 64));
  some.giveTo(others, 3);
  EXPECT_EQ(pool.used(), 3 * 64);
  others.clear();
  EXPECT_EQ(pool.used(), 0);
}

} // namespace smg::testing
