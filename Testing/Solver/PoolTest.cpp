// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Pool.h"
#include "Solver/Memory/Buffer.h"
#include "Testing/Solver/SolveTesting.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace smg::testing
{

TEST(Pool, CountsWhatIsInUseAndItsPeak)
{
  Pool pool(1000);
  pool.acquire(600);
  pool.release(200);
  pool.acquire(100);
  EXPECT_EQ(pool.used(), 500);
  EXPECT_EQ(pool.peak(), 600);
  EXPECT_EQ(pool.limit(), 1000);
  pool.acquire(500);
  EXPECT_EQ(pool.used(), 1000);
}

TEST(Pool, RefusesWhatIsAboveItsLimitAndNamesBothFigures)
{
  Pool pool(3000000);
  pool.acquire(1000000);
  const std::string sentence = messageOf([&] { pool.acquire(2500000); });
  EXPECT_NE(sentence.find("3500000 bytes"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("3000000 bytes"), std::string::npos) << sentence;
  EXPECT_EQ(pool.used(), 1000000);
  EXPECT_EQ(pool.peak(), 1000000);
  pool.acquire(2000000);
}

TEST(Pool, SaysWhatNeedsTheMemoryAndWhatToDo)
{
  Pool pool(1000, { "the walk", "take a shorter one" });
  const std::string sentence = messageOf([&] { pool.acquire(1001); });
  EXPECT_EQ(sentence.find("the walk needs at least"), 0U) << sentence;
  EXPECT_NE(sentence.find(": take a shorter one"), std::string::npos) << sentence;
}

TEST(Pool, RefusesSizesWhoseSumIsNoNumber)
{
  Pool pool(1000);
  pool.acquire(600);
  constexpr std::int64_t Most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t bytes : { Most, Most - 599, std::int64_t(-1), -Most })
  {
    EXPECT_NE(messageOf([&] { pool.acquire(bytes); }), "");
    EXPECT_EQ(pool.used(), 600);
  }
  // Sizes that no pool can count, such as that of a buffer whose size overflows.
  for (const std::size_t bytes : { SIZE_MAX, SIZE_MAX - 63, SIZE_MAX / 2 + 1 })
  {
    EXPECT_NE(messageOf([&] { const Buffer buffer(pool, bytes); }), "");
    EXPECT_EQ(pool.used(), 600);
  }
}

} // namespace smg::testing
