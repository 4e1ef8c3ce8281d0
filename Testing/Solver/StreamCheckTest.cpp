// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Mesh/StreamCheck.h"

#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/Unwelded.h"

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
    { [](MeshBlock& b)
      { b.cellColumns = { makeColumn<double>(CellFlagsName, std::vector<double>{ 0.0 }) }; },
      "CellFlags of the block that begins with cell 1 must have one number of type uint8" },
    { [](MeshBlock& b)
      { b.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, std::vector<std::uint8_t>{}) }; },
      "CellFlags of the block" },
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

TEST(StreamCheck, OnlyAPartBeginsWithAnyCell)
{
  class Later : public MemorySource
  {
  public:
    using MemorySource::MemorySource;
    bool next(MeshBlock& block) override
    {
      const bool isMore = MemorySource::next(block);
      block.firstCell += 5;
      return isMore;
    }
  };
  const StreamMesh mesh = toStream(grid(4, 4));
  const auto visit = [](const MeshBlock&) {};
  Later whole(mesh), part(mesh);
  EXPECT_THROW(forCheckedBlocks(whole, visit), Error);
  EXPECT_EQ(forCheckedBlocks(part, visit, true).cells(), mesh.cells() + 5);
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

TEST(StreamCheck, NotesMeshesWhoseCellsShareNothing)
{
  const auto note = [](const IndexedTestMesh& mesh)
  { return unweldedNote(mesh.cellType, mesh.vertices(), mesh.cells()); };
  IndexedTestMesh grains = sphere(0);
  for (int k = 0; k < 7; ++k)
  {
    grains = disjointUnion(grains, grains); // 128 bodies of 20 triangles
  }
  for (const IndexedTestMesh& mesh : { grid(12, 12), torus(10, 12), tetBox(5, 5, 5), grains })
  {
    EXPECT_EQ(note(mesh), "");
    EXPECT_TRUE(contains(note(unwelded(mesh)), "--weld 0")) << note(unwelded(mesh));
  }
  EXPECT_EQ(note(unwelded(sphere(0))), "") << "few cells may be anything";
}

} // namespace smg::testing
