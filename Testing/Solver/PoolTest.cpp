// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/Pool.h"
#include "Solver/Core/Error.h"
#include "Testing/Solver/SolveTesting.h"

#include <gtest/gtest.h>

namespace smg::testing
{

TEST(Pool, countsWhatIsInUseAndItsPeak)
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

TEST(Pool, refusesWhatIsAboveItsLimitAndNamesBothFigures)
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

} // namespace smg::testing
