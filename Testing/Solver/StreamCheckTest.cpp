// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Stream/StreamCheck.h"

#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{

TEST(StreamCheck, AcceptsValidStreams)
{
  const StreamMesh mesh = toStream(shuffled(torus(30, 20)));
  for (const std::int64_t blockCells : { 1, 7, 100000 })
  {
    MemorySource source(mesh, blockCells);
    StreamCheck check(mesh.cellType);
    MeshBlock block;
    while (source.next(block))
    {
      check.add(block);
    }
    EXPECT_EQ(check.vertices(), mesh.vertices());
    check.finish(source.info());
  }
}

TEST(StreamCheck, NamesWhatIsWrong)
{
  std::vector<MeshBlock> blocks = twoBlocks();
  blocks[0].finalized = 1;
  const std::vector<std::pair<std::function<void(MeshBlock&)>, std::string>> faults{
    { [](MeshBlock& b) { b.firstVertex = 5; }, "expected 3 and 1" },
    { [](MeshBlock& b) { b.firstCell = 0; }, "expected 3 and 1" },
    { [](MeshBlock& b) { b.positions.pop_back(); }, "in the middle" },
    { [](MeshBlock& b) { b.corners.pop_back(); }, "in the middle" },
    { [](MeshBlock& b) { b.positions[1] = std::numeric_limits<double>::quiet_NaN(); },
      "vertex 3 is not a finite number" },
    { [](MeshBlock& b) { b.corners[1] = 4; }, "cell 1 uses vertex 4, which is not defined yet" },
    { [](MeshBlock& b) { b.corners[2] = 0; }, "cell 1 uses vertex 0, which was declared final" },
    { [](MeshBlock& b) { b.finalized = 5; }, "declares 5 vertices final but only 4" },
    { [](MeshBlock& b) { b.finalized = 0; }, "declares 0 vertices final, an earlier one 1" },
  };
  for (const auto& [damage, part] : faults)
  {
    StreamCheck check(CellType::Triangle);
    check.add(blocks[0]);
    MeshBlock block = blocks[1];
    damage(block);
    expectError([&] { check.add(block); }, part);
  }
}

TEST(StreamCheck, NoticesAStreamThatEndsEarly)
{
  StreamCheck check(CellType::Triangle);
  for (const MeshBlock& block : twoBlocks())
  {
    check.add(block);
  }
  StreamInfo info; // no counts
  check.finish(info);
  info.vertices = 4;
  info.cells = 2;
  check.finish(info);
  info.cells = 3;
  expectError([&] { check.finish(info); }, "4 vertices and 2 cells, but it states 4 and 3");
  info.cells = 0;
  info.vertices = 5;
  expectError([&] { check.finish(info); }, "4 vertices and 2 cells, but it states 5 and 0");
}

} // namespace smg::testing
