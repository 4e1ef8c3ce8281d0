// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/PagedArray.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "IO/Order/Pages/VertexStar.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

using Indices = std::vector<std::uint32_t>;

constexpr std::int64_t MaxNumbers = (std::int64_t(1) << 32) - 2;

/** Indices on both sides of 2^31, and the largest ones of a conversion, ascending. */
Indices largeNumbers()
{
  Indices numbers(400);
  std::iota(numbers.begin(), numbers.begin() + 200, (1U << 31) - 100);
  std::iota(numbers.begin() + 200, numbers.end(), static_cast<std::uint32_t>(MaxNumbers - 200));
  return numbers;
}

class LargeNumbers : public ::testing::Test
{
protected:
  TemporaryFolder Folder;
  Workspace Space{ this->Folder.path(), Workspace::MinMemory };
};

/** What CellGroups, VertexLinks and VertexStar find, ranks relative to the first one. */
struct Around
{
  std::vector<Indices> neighbours;
  std::vector<std::int64_t> boundary, fans;
  bool operator==(const Around&) const = default;
};

} // namespace

TEST_F(LargeNumbers, AreReplaced)
{
  Relabelling labels(this->Space, MaxNumbers, std::int64_t(4) << 20);
  RecordFile<std::uint32_t> file(this->Space);
  Indices expected;
  for (const std::uint32_t number : largeNumbers())
  {
    labels.put(number, ~number);
    file.put(number);
    file.put(number - 1000); // has no label
    expected.insert(expected.end(), { ~number, NoIndex });
  }
  file.close();
  EXPECT_LE(labels.passes(), 4);
  Indices replaced;
  labels.apply(file, 2,
    [&](std::span<const std::uint32_t> record)
    { replaced.insert(replaced.end(), record.begin(), record.end()); });
  EXPECT_EQ(replaced, expected);
}

TEST_F(LargeNumbers, OfRowsOfATable)
{
  RowTable table(this->Space, MaxNumbers, sizeof(std::uint64_t), std::int64_t(4) << 20);
  for (const std::uint32_t number : largeNumbers())
  {
    const std::uint64_t square = std::uint64_t(number) * number;
    table.put(number, std::as_bytes(std::span(&square, 1)));
  }
  table.close();
  for (const std::uint32_t number : largeNumbers())
  {
    const std::span<const std::byte> row = table.read(number, 1);
    std::uint64_t square = 0;
    ASSERT_EQ(row.size(), sizeof(square));
    std::memcpy(&square, row.data(), sizeof(square));
    EXPECT_EQ(square, std::uint64_t(number) * number);
  }
}

TEST_F(LargeNumbers, OfAPagedArray)
{
  for (const std::int64_t first :
    { (std::int64_t(1) << 31) - 9000, (std::int64_t(1) << 32) - 9000 })
  {
    PagedArray<std::int64_t> values(this->Folder.path(), 1);
    for (std::int64_t i = first; i < first + 20000; ++i)
    {
      values.at(i) = 3 * i;
    }
    for (std::int64_t i = first; i < first + 20000; ++i)
    {
      ASSERT_EQ(values.get(i), 3 * i);
      if (i % 1000 == 0)
      {
        values.discardBelow(i);
      }
    }
  }
}

TEST_F(LargeNumbers, OfTheCornersOfCells)
{
  const Indices numbers = largeNumbers();
  for (std::size_t i = 0; i + 4 <= numbers.size(); ++i)
  {
    const std::array corners{ numbers[i + 1], numbers[i + 3], numbers[i], numbers[i + 2] };
    const auto cell = placedCell<4>(corners.data(), NoIndex - 2);
    EXPECT_TRUE(std::ranges::is_sorted(cell.places, std::greater()));
    std::array<std::uint32_t, 4> inFile{};
    cell.inFile(inFile);
    EXPECT_EQ(inFile, corners);
    EXPECT_EQ(cell.element, NoIndex - 2);
  }
}

/** Stretches of ranks that end with the largest ones, or lie across 2^31. */
TEST_F(LargeNumbers, OfTheVerticesAroundAVertex)
{
  const IndexedTestMesh mesh = grid(20, 15);
  const std::int64_t vertices = mesh.vertices();
  const auto around = [&](std::int64_t first)
  {
    CellGroups groups(this->Space, { first, first + vertices }, 64, 3, std::int64_t(1) << 20);
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    {
      std::array<std::uint32_t, 3> cell;
      std::ranges::transform(std::span(mesh.corners).subspan(c, 3), cell.begin(),
        [first](std::int64_t corner) { return static_cast<std::uint32_t>(first + corner); });
      groups.put(cell);
    }
    groups.close();
    Around found;
    for (int group = 0; group < groups.groups(); ++group)
    {
      const RankRange range = groups.range(group);
      VertexLinks links(this->Space, groups, group, 3);
      links.load(this->Space, groups, group);
      VertexStar star(this->Space.pool(), range, links.largest());
      for (std::int64_t rank = range.begin; rank < range.end; ++rank)
      {
        const auto vertex = static_cast<std::uint32_t>(rank);
        Indices& neighbours = found.neighbours.emplace_back(links.of(vertex).size());
        neighbours.resize(star.visit(vertex, links.of(vertex), 3, neighbours));
        for (std::uint32_t& neighbour : neighbours)
        {
          neighbour -= static_cast<std::uint32_t>(first);
        }
        found.boundary.push_back(star.boundaryEdges());
        found.fans.push_back(star.fans());
      }
    }
    return found;
  };
  const Around expected = around(0);
  ASSERT_EQ(std::ssize(expected.neighbours), vertices);
  EXPECT_EQ(around((std::int64_t(1) << 31) - 130), expected);
  EXPECT_EQ(around(MaxNumbers - vertices), expected);
}

} // namespace smg::testing
