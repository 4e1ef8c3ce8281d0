// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/TriangleChains.h"

#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace smg::testing
{
namespace
{

using Triangle = std::array<std::uint32_t, 3>;

/** As VTK's triangle filter splits it. */
std::vector<Triangle> trianglesOf(const std::vector<std::uint32_t>& strip)
{
  std::vector<Triangle> triangles;
  for (std::size_t k = 2; k < strip.size(); ++k)
  {
    k % 2 == 0 ? triangles.push_back({ strip[k - 2], strip[k - 1], strip[k] })
               : triangles.push_back({ strip[k - 1], strip[k - 2], strip[k] });
  }
  return triangles;
}

/** The triangles in the order that is found; empty: none is. */
std::vector<Triangle> inOrder(const std::vector<Triangle>& triangles)
{
  std::vector<std::uint32_t> corners;
  for (const Triangle& triangle : triangles)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  StripChain chain;
  std::vector<Triangle> ordered;
  if (chain.build(corners))
  {
    for (const std::uint32_t place : chain.order())
    {
      ordered.push_back(triangles[place]);
    }
  }
  return ordered;
}

TEST(StripChain, FindsTheOrderWhateverItWas)
{
  Random random(1);
  for (std::size_t corners = 3; corners < 60; ++corners)
  {
    std::vector<std::uint32_t> strip(corners);
    std::iota(strip.begin(), strip.end(), 7u);
    for (std::size_t i = corners; i > 1; --i)
    {
      std::swap(strip[i - 1], strip[std::size_t(random.below(std::int64_t(i)))]);
    }
    const std::vector<Triangle> expected = trianglesOf(strip);
    std::vector<Triangle> triangles = expected;
    for (std::size_t i = triangles.size(); i > 1; --i)
    {
      std::swap(triangles[i - 1], triangles[std::size_t(random.below(std::int64_t(i)))]);
    }
    EXPECT_EQ(inOrder(triangles), expected) << corners;
    std::ranges::reverse(triangles);
    EXPECT_EQ(inOrder(triangles), expected) << corners;
  }
}

TEST(StripChain, WhatIsNoStripHasNoOrder)
{
  EXPECT_TRUE(inOrder({ { 0, 1, 2 }, { 3, 4, 5 } }).empty());
  EXPECT_TRUE(inOrder({ { 0, 1, 2 }, { 0, 1, 3 } }).empty());
  // A triangle that is wound the other way.
  EXPECT_TRUE(inOrder({ { 0, 1, 2 }, { 1, 2, 3 } }).empty());
  // A band may begin anywhere.
  EXPECT_TRUE(inOrder(trianglesOf({ 0, 1, 2, 3, 4, 5, 0, 1 })).empty());
}

} // namespace
} // namespace smg::testing
