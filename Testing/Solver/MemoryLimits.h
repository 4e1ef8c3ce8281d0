// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemorySource.h"
#include "Testing/Support/ScratchError.h"
#include "smg/Report.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace smg::testing
{

/** Checks that `run`, with increasing memory limits up to `last`, fails until the limit is
 * sufficient and then stays within it. */
template <class Options>
void expectLimitsKept(Options options, std::int64_t last, const auto& run)
{
  int done = 0;
  for (options.memoryLimit = 1 << 18; options.memoryLimit <= last; options.memoryLimit *= 2)
  {
    Report report;
    if (messageOf([&] { report = run(options); }).empty())
    {
      ++done;
      EXPECT_LE(report.pool_bytes_peak, options.memoryLimit);
    }
    else
    {
      EXPECT_EQ(done, 0) << "more memory is enough, too";
    }
  }
  EXPECT_GE(done, 2);
  EXPECT_LE(done, 8);
}

/** Checks that `run`, which receives a source of the mesh and the options, immediately reports that
 * the memory limit is too low. */
template <class Options>
void expectLimitRefused(const StreamMesh& mesh, const Options& options, const auto& run)
{
  MemorySource source(mesh);
  const std::string sentence =
    scratchErrorOf(options, [&](const Options& limited) { run(source, limited); });
  EXPECT_NE(sentence.find(std::to_string(options.memoryLimit) + " bytes"), std::string::npos)
    << sentence;
  EXPECT_NE(sentence.find("at least"), std::string::npos) << sentence;
  MeshBlock block;
  EXPECT_TRUE(source.next(block) && block.firstCell == 0) << "the mesh was read before the error";
}

} // namespace smg::testing
