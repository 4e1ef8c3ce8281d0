// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Engine/MemoryEstimate.h"

#include "Testing/Support/ArrayProblem.h"

#include <gtest/gtest.h>

namespace smg::testing
{

TEST(MemoryEstimate, TasksNeedALimitThatIsKnownToSuffice)
{
  ArrayProblem problem;
  StreamInfo info;
  info.vertices = 1000000;
  info.cells = 2000000;
  info.span = 1000000;
  SolveOptions options;
  for (options.memoryLimit = std::int64_t(1) << 20; options.memoryLimit < std::int64_t(1) << 40;
       options.memoryLimit *= 2)
  {
    StreamInfo unknown = info;
    unknown.span = -1;
    // As in the worst order.
    EXPECT_EQ(permitsTasks(unknown, problem, options), permitsTasks(info, problem, options));
    unknown.vertices = -1;
    EXPECT_FALSE(permitsTasks(unknown, problem, options));
  }
  options.memoryLimit = std::int64_t(16) << 20;
  EXPECT_FALSE(permitsTasks(info, problem, options));
  options.memoryLimit = std::int64_t(1) << 40;
  EXPECT_TRUE(permitsTasks(info, problem, options));
}

} // namespace smg::testing
