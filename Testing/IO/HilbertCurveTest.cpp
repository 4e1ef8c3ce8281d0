// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/EdgeMetric.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <map>

namespace smg::testing
{
namespace
{

using Cell = std::array<std::uint32_t, 3>;

/** Expects the cube of 8^3 cells to be a contiguous part of the curve, from cell to neighbouring
 * cell. */
void expectCurveThroughCube(const HilbertCurve& curve, const Cell& corner)
{
  std::map<std::uint64_t, Cell> cells;
  for (std::uint32_t i = 0; i < 512; ++i)
  {
    const Cell cell{ corner[0] + i % 8, corner[1] + i / 8 % 8, corner[2] + i / 64 };
    cells[curve.key(cell[0], cell[1], cell[2])] = cell;
  }
  ASSERT_EQ(cells.size(), 512u) << "two cells with one key";
  EXPECT_EQ(cells.begin()->first % 512, 0u);
  EXPECT_EQ(cells.rbegin()->first - cells.begin()->first, 511u);
  for (auto next = std::next(cells.begin()); next != cells.end(); ++next)
  {
    std::int64_t steps = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      steps += std::abs(std::int64_t(next->second[k]) - std::int64_t(std::prev(next)->second[k]));
    }
    EXPECT_EQ(steps, 1) << "the curve leaps at key " << next->first;
  }
}

TEST(HilbertCurve, GoesFromCellToCell)
{
  const HilbertCurve curve;
  EXPECT_EQ(curve.key(0, 0, 0), 0u);
  expectCurveThroughCube(curve, { 0, 0, 0 });
  constexpr std::uint32_t last = HilbertCurve::Largest - 7;
  expectCurveThroughCube(curve, { last, last, last });
  Random random(1);
  for (int i = 0; i < 200; ++i)
  {
    Cell corner;
    for (std::uint32_t& coordinate : corner)
    {
      coordinate = static_cast<std::uint32_t>(random.below(HilbertCurve::Largest / 8 + 1)) * 8;
    }
    expectCurveThroughCube(curve, corner);
  }
}

TEST(HilbertCurve, FillsTheCube)
{
  const HilbertCurve curve;
  constexpr std::uint32_t most = HilbertCurve::Largest;
  std::uint64_t largest = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    largest = std::max(
      largest, curve.key(corner & 1 ? most : 0, corner & 2 ? most : 0, corner & 4 ? most : 0));
  }
  EXPECT_EQ(largest, (std::uint64_t(1) << 63) - 1) << "the curve ends in a corner";
}

} // namespace
} // namespace smg::testing
