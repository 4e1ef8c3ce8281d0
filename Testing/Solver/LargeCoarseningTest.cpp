// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/RowBlockPacker.h"
#include "Solver/Multigrid/Extended.h"
#include "Testing/Solver/CoarseningTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

/** The first nodes of two levels. */
struct FirstNodes
{
  std::int64_t fine = 0, coarse = 0;
};

/** Numbers that begin shortly below those which 31, 32 or 33 bits hold. */
const std::vector<FirstNodes> largeNodes = {
  { (std::int64_t(1) << 31) - 100, (std::int64_t(1) << 31) - 30 },
  { (std::int64_t(1) << 32) - 100, (std::int64_t(1) << 32) - 30 },
  { (std::int64_t(1) << 32) - 1, (std::int64_t(1) << 32) - 1 },
  { (std::int64_t(5) << 32) - 300, (std::int64_t(1) << 33) - 50 },
};

/** The stored bytes of a block with all numbers relative to the first nodes. */
std::vector<std::byte> relative(const RowBlock& block, const FirstNodes& first)
{
  RowBlock::Header h = block.header();
  h.first -= first.fine;
  h.parentBase -= h.parents > 0 ? first.coarse : 0;
  for (std::int64_t group = 0; group * RowBlock::Group < h.nodes; ++group)
  {
    const auto g = static_cast<std::size_t>(group);
    h.neighbourReach[g] -= first.fine;
    h.patchReach[g] -= first.fine;
    h.parentReach[g] -= first.coarse;
  }
  std::vector<std::byte> bytes(block.stored().begin(), block.stored().end());
  std::memcpy(bytes.data(), &h, sizeof(h));
  return bytes;
}

/** What a coarsening makes, relative to the first nodes. */
struct Made
{
  std::vector<std::vector<std::byte>> blocks;
  TestLevel coarse;
  std::vector<std::int64_t> childReach;
};

void keepRows(const LevelRows& coarse, const FirstNodes& first, Made& made)
{
  const std::int64_t begin = first.coarse + made.coarse.nodes();
  for (std::int64_t c = begin; c < coarse.end(); ++c)
  {
    const auto row = coarse.row(c);
    made.coarse.rows.emplace_back(row.begin(), row.end());
    made.coarse.rowSum.push_back(coarse.rowSum(c));
    EXPECT_GE(coarse.reach(c), c);
    made.childReach.push_back(coarse.childReach(c) - first.fine);
  }
}

/** Coarsens a level whose rows come in batches; `pipelined`: as on several threads. */
Made coarsenFrom(const FirstNodes& first, const TestLevel& level, const Extended& operators,
  std::int64_t batch, bool pipelined)
{
  constexpr std::int64_t BlockNodes = 96;
  Pool pool(std::int64_t(1) << 30);
  SpareBuffers buffers(pool);
  LevelRows fine(pool), coarse(pool);
  fine.release(first.fine, first.fine);
  coarse.release(first.coarse, first.coarse);
  Coarsening<Extended> step(pool, operators, fine, coarse, {}, pipelined);
  Made made;
  std::int64_t packed = first.fine;
  for (std::int64_t begin = 0; !coarse.Ended;)
  {
    const std::int64_t end = std::min(begin + batch, level.nodes());
    level.append(fine, begin, end);
    fine.Ended = end == level.nodes();
    begin = end;
    if (pipelined)
    {
      step.beginPipelined(batch);
      step.advanceCoarseRows();
      step.advanceGathering();
      step.advanceInterpolation();
      step.advanceChoice();
      step.advanceProducts();
    }
    else
    {
      step.advance();
    }
    const bool ended = fine.Ended && step.multiplied() == fine.end();
    while (packed + BlockNodes <= step.multiplied() || (ended && packed < fine.end()))
    {
      const std::int64_t nodes = std::min(BlockNodes, fine.end() - packed);
      made.blocks.push_back(
        relative(packRows(buffers, fine, &step.data(), packed, nodes, true), first));
      packed += nodes;
      step.packed(packed);
    }
    step.handOver();
    step.release();
    keepRows(coarse, first, made);
  }
  return made;
}

} // namespace

TEST(LargeIndices, CoarseningMakesTheSameBits)
{
  for (const CoarseningCase& test : coarseningCases())
  {
    const Extended operators = Extended::forCells(
      test.name.find("tetrahedra") != std::string::npos || test.name.starts_with("box")
        ? CellType::Tetrahedron
        : CellType::Triangle);
    const Made expected = coarsenFrom({}, test.level, operators, 64, false);
    ASSERT_GT(expected.coarse.nodes(), 3) << test.name;
    for (const FirstNodes& first : largeNodes)
    {
      for (const bool pipelined : { false, true })
      {
        const Made made = coarsenFrom(first, test.level, operators, 64, pipelined);
        ASSERT_TRUE(sameLevels(made.coarse, expected.coarse)) << test.name << ", " << first.fine;
        EXPECT_EQ(made.childReach, expected.childReach) << test.name << ", " << first.fine;
        EXPECT_TRUE(made.blocks == expected.blocks) << test.name << ", " << first.fine;
      }
    }
  }
}

} // namespace smg::testing
