// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace smg::testing
{

/** The progress reported by an operation. */
class ProgressRecord
{
public:
  /** A callback that never cancels; the record must outlive it. */
  ProgressFunction function()
  {
    return [this](double fraction)
    {
      this->Seen.push_back(fraction);
      return true;
    };
  }

  /** Checks that the fractions increase from near 0 to 1 in steps smaller than `largestJump`. */
  void expectRise(double largestJump) const
  {
    ASSERT_GT(this->Seen.size(), 50U);
    EXPECT_LT(this->Seen.front(), 0.1);
    EXPECT_GE(this->Seen.front(), 0.0);
    EXPECT_EQ(this->Seen.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(this->Seen.begin(), this->Seen.end()));
    double jump = 0.0;
    for (std::size_t k = 1; k < this->Seen.size(); ++k)
    {
      jump = std::max(jump, this->Seen[k] - this->Seen[k - 1]);
    }
    EXPECT_LT(jump, largestJump);
  }

private:
  std::vector<double> Seen;
};

} // namespace smg::testing
