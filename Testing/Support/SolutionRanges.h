// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/SolveMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace smg::testing
{

/** Checks that ranges of a solution, read in any order, equal those of the whole bit for bit. */
inline void expectRangesOfTheWhole(Solution& solution)
{
  const Eigen::MatrixXd whole = valuesOf(solution);
  const int columns = solution.columns();
  Random random(9);
  for (int trial = 0; trial < 200; ++trial)
  {
    const std::int64_t first = random.below(solution.vertices() + 1);
    const std::int64_t rest = solution.vertices() - first;
    const std::int64_t count = random.below(std::min<std::int64_t>(rest, trial % 2 ? 5 : 5000) + 1);
    std::vector<double> part(columns * count + 1, -77.0);
    solution.read(first, count, part);
    for (std::int64_t i = 0; i < count * columns; ++i)
    {
      ASSERT_EQ(part[i], whole(first + i / columns, i % columns));
    }
    EXPECT_EQ(part.back(), -77.0);
  }
}

} // namespace smg::testing
