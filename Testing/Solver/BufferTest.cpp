// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Memory/Buffer.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace smg::testing
{

TEST(Buffer, IsAlignedAndCountedInThePool)
{
  Pool pool(10000);
  {
    const Buffer buffer(pool, 100);
    EXPECT_EQ(buffer.size(), 100U);
    EXPECT_EQ(buffer.bytes().size(), 100U);
    EXPECT_GE(buffer.capacity(), buffer.size());
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0U);
    EXPECT_EQ(pool.used(), static_cast<std::int64_t>(buffer.capacity()));
  }
  EXPECT_EQ(pool.used(), 0);
}

TEST(Buffer, MovesWithoutCopying)
{
  Pool pool(10000);
  {
    Buffer a(pool, 64);
    a.data()[3] = std::byte{ 42 };
    const std::byte* place = a.data();
    Buffer b(std::move(a));
    EXPECT_EQ(b.data(), place);
    Buffer c(pool, 128);
    c = std::move(b);
    EXPECT_EQ(c.data()[3], std::byte{ 42 });
    EXPECT_EQ(c.size(), 64U);
  }
  EXPECT_EQ(pool.used(), 0);
}

TEST(Buffer, MayBeUsedInPart)
{
  Pool pool(10000);
  Buffer buffer(pool, 1000);
  buffer.resize(10);
  EXPECT_EQ(buffer.bytes().size(), 10U);
  EXPECT_GE(buffer.capacity(), 1000U);
}

TEST(Buffer, AboveTheLimitIsRefused)
{
  Pool pool(1000);
  EXPECT_THROW(Buffer(pool, 2000), Error);
  EXPECT_EQ(pool.used(), 0);
  EXPECT_NO_THROW(Buffer(pool, 0));
}

} // namespace smg::testing
