// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/MovedVertices.h"

#include "Solver/Mesh/AddedColumn.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/Sanitized.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

std::array<double, 3> positionOf(std::int64_t id)
{
  return { double(id), double(-id), 0.5 };
}

/** Vertices of these numbers at positionOf() these, `step` a block, and no cells. */
class NumberedSource : public MeshSource
{
public:
  explicit NumberedSource(std::vector<std::int64_t> ids, std::size_t step = 777)
    : Ids(std::move(ids))
    , Step(step)
  {
    this->Info.vertices = static_cast<std::int64_t>(this->Ids.size());
    this->Info.vertexColumns = { OriginalIdSpec };
  }

  const StreamInfo& info() const override { return this->Info; }

  bool next(MeshBlock& block) override
  {
    const std::span some =
      std::span(this->Ids).subspan(this->Next, std::min(this->Step, this->Ids.size() - this->Next));
    this->Next += some.size();
    block.positions.clear();
    for (const std::int64_t id : some)
    {
      const auto position = positionOf(id);
      block.positions.insert(block.positions.end(), position.begin(), position.end());
    }
    block.vertexColumns.assign(1, makeColumn<std::int64_t>(OriginalIdName, some));
    return !some.empty();
  }

private:
  StreamInfo Info;
  std::vector<std::int64_t> Ids;
  std::size_t Step, Next = 0;
};

std::vector<std::int64_t> shuffledNumbers(std::int64_t count)
{
  std::vector<std::int64_t> ids(static_cast<std::size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  std::shuffle(ids.begin(), ids.end(), std::mt19937(7));
  return ids;
}

/** Looks for a range and expects the position of each number that `has` says is in the stream. */
void expectRange(MovedVertices& moved, std::int64_t first, std::int64_t count, const auto& has)
{
  for (std::int64_t id = first; id < first + count; ++id)
  {
    ASSERT_EQ(moved.find(id), has(id)) << id;
    if (has(id))
    {
      ASSERT_TRUE(std::ranges::equal(moved.position(), positionOf(id))) << id;
    }
  }
}

TEST(MovedVertices, AreFoundByNumberWhateverTheirOrder)
{
  // 60 MB of vertices in 16 MiB, and in memory.
  constexpr std::int64_t Count = 1500000;
  for (const std::int64_t memory : { std::int64_t(MinMebibytes) << 20, std::int64_t(200) << 20 })
  {
    const TemporaryFolder folder;
    Workspace workspace(folder.path(), memory);
    NumberedSource source(shuffledNumbers(Count));
    MovedVertices moved(source, workspace);
    const auto all = [](std::int64_t id) { return id < Count; };
    expectRange(moved, 0, Count + 10, all);
    expectRange(moved, 49999, 50000, all);
    expectRange(moved, Count - 1, 1, all);
    expectRange(moved, 5, 1, all);
    expectRange(moved, 5, 1, all);
    EXPECT_LE(workspace.pool().used(), std::int64_t(2) * std::int64_t(BucketFile::ChunkBytes));
  }
}

TEST(MovedVertices, MayLackNumbers)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), std::int64_t(MinMebibytes) << 20);
  std::vector<std::int64_t> ids = shuffledNumbers(500000);
  std::erase_if(ids, [](std::int64_t id) { return id % 3 == 1 || (id > 50000 && id < 120000); });
  ids.push_back(std::int64_t(1) << 52);
  NumberedSource source(ids);
  MovedVertices moved(source, workspace);
  const auto has = [](std::int64_t id)
  {
    return id == std::int64_t(1) << 52 ||
           (id < 500000 && id % 3 != 1 && !(id > 50000 && id < 120000));
  };
  expectRange(moved, 0, 550000, has);
  expectRange(moved, (std::int64_t(1) << 52) - 1, 3, has);
  moved.check((std::int64_t(1) << 52) + 1, "in");
  expectError([&] { moved.check(500000, "in"); }, "only 500000 vertices");
}

/** A stream whose last vertices have the numbers of its first ones. */
class RepeatedSource : public NumberedSource
{
public:
  RepeatedSource()
    : NumberedSource({ 2, 0, 2, 1, 0 }, 1)
  {
  }

  bool next(MeshBlock& block) override
  {
    const bool more = this->NumberedSource::next(block);
    if (more)
    {
      block.positions[2] = this->Place++;
    }
    return more;
  }

private:
  double Place = 0;
};

TEST(MovedVertices, AreTheLastOnesOfTheirNumbers)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), std::int64_t(MinMebibytes) << 20);
  RepeatedSource source;
  MovedVertices moved(source, workspace);
  for (const auto& [vertex, place] : { std::pair{ 0, 4.0 }, { 1, 3.0 }, { 2, 2.0 } })
  {
    ASSERT_TRUE(moved.find(vertex));
    EXPECT_EQ(moved.position()[2], place);
  }
}

TEST(MovedVertices, HaveNoNegativeNumbers)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), std::int64_t(MinMebibytes) << 20);
  NumberedSource source({ 2, -1 });
  expectError([&] { MovedVertices(source, workspace); }, "-1 of a vertex is negative");
}

} // namespace
} // namespace smg::testing
