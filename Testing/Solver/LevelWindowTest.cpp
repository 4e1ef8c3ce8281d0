// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/LevelWindow.h"

#include "Solver/Multigrid/Cycle/RowBlockPacker.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace smg::testing
{
namespace
{

constexpr std::int64_t StoredNodes = 2500; // two blocks and a half
constexpr int StoredColumns = 2;

/** A level of rows without entries on scratch files, whose x and b are numbers of their own. */
class StoredLevel
{
public:
  StoredLevel()
    : Memory(std::int64_t(1) << 30)
    , window(this->Memory, this->Resident, 0, StoredColumns)
  {
    this->window.useScratch(ScratchFolder(this->Folder.path()), this->Traffic);
    this->window.startPass(true);
    LevelRows rows(this->Memory);
    for (std::int64_t i = 0; i < StoredNodes; ++i)
    {
      rows.open(0);
      rows.close(0, 1.0, -1);
    }
    SpareBuffers buffers(this->Memory);
    for (std::int64_t begin = 0; begin < StoredNodes; begin += RowBlock::Nodes)
    {
      this->window.append(packRows(
        buffers, rows, nullptr, begin, std::min(RowBlock::Nodes, StoredNodes - begin), false));
    }
    for (std::int64_t i = 0; i < StoredNodes; ++i)
    {
      for (int k = 0; k < StoredColumns; ++k)
      {
        this->window.x().at(i)[k] = xOf(i, k);
        this->window.b().at(i)[k] = -1.0;
      }
    }
    this->window.write(StoredNodes);
    this->window.release(StoredNodes);
    this->window.endPass();
  }

  static double xOf(std::int64_t i, int k) { return static_cast<double>(10 * i + k); }

  /** Whether x of these nodes is read as it was written. */
  bool reads(std::int64_t first, std::int64_t count)
  {
    std::vector<double> x(static_cast<std::size_t>(count * StoredColumns));
    this->window.readX(first, count, x.data());
    bool same = true;
    for (std::int64_t i = 0; i < count * StoredColumns; ++i)
    {
      same = same && x[static_cast<std::size_t>(i)] ==
                       xOf(first + i / StoredColumns, static_cast<int>(i % StoredColumns));
    }
    return same;
  }

private:
  TemporaryFolder Folder;
  Pool Memory;
  ResidentNodes Resident;
  ScratchTraffic Traffic;

public:
  LevelWindow<double> window;
};

} // namespace

/** Both use the same memory for the block at hand. */
TEST(LevelWindow, ReadsItsSolutionAfterItsRightSideWasRewritten)
{
  StoredLevel level;
  for (const std::int64_t first : { std::int64_t(2100), std::int64_t(5), std::int64_t(2049) })
  {
    EXPECT_TRUE(level.reads(first, 100)) << first;
    level.window.rewriteB([](std::int64_t block, std::span<double> b)
      { std::ranges::fill(b, static_cast<double>(block)); });
    EXPECT_TRUE(level.reads(first, 100)) << first;
    EXPECT_TRUE(level.reads(0, StoredNodes));
  }
  level.window.rewriteB([](std::int64_t block, std::span<double> b)
    { EXPECT_TRUE(std::ranges::all_of(b, [=](double value) { return value == block; })); });
}

TEST(LevelWindow, RewritesItsSolutionAndKeepsItsRightSide)
{
  StoredLevel level;
  level.window.rewriteB([](std::int64_t block, std::span<double> b)
    { std::ranges::fill(b, static_cast<double>(block)); });
  EXPECT_TRUE(level.reads(5, 100));
  level.window.rewriteX([](std::int64_t, std::span<double> x)
    { std::ranges::for_each(x, [](double& value) { value += 1.0; }); });
  EXPECT_FALSE(level.reads(5, 100));
  level.window.rewriteX([](std::int64_t, std::span<double> x)
    { std::ranges::for_each(x, [](double& value) { value -= 1.0; }); });
  EXPECT_TRUE(level.reads(0, StoredNodes));
  level.window.rewriteB([](std::int64_t block, std::span<double> b)
    { EXPECT_TRUE(std::ranges::all_of(b, [=](double value) { return value == block; })); });
}

} // namespace smg::testing
