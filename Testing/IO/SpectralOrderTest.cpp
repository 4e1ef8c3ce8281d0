// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Search/SpectralOrder.h"
#include "IO/Order/Search/AxisOrder.h"
#include "Testing/IO/MortonPages.h"
#include "Testing/Support/Sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

constexpr std::int64_t Memory = std::int64_t(64) << 20;

/** Appends a grid of triangles; vertex (column, row) is at `point` of both. `closed`: the last
 * column and row are followed by the first. */
template <class Point>
void addGrid(CoreMesh& mesh, std::uint32_t columns, std::uint32_t rows, bool closed, Point&& point)
{
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t i = 0; i < columns * rows; ++i)
  {
    mesh.points.push_back(point(i / rows, i % rows));
  }
  const auto at = [&](std::uint32_t column, std::uint32_t row)
  { return first + column % columns * rows + row % rows; };
  for (std::uint32_t i = 0; i + (closed ? 0 : 1) < columns; ++i)
  {
    for (std::uint32_t j = 0; j + (closed ? 0 : 1) < rows; ++j)
    {
      for (const std::uint32_t corner :
        { at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1) })
      {
        mesh.corners.push_back(corner);
      }
    }
  }
}

CoreMesh plate(std::uint32_t columns, std::uint32_t rows, double x = 0)
{
  CoreMesh mesh;
  addGrid(mesh, columns, rows, false,
    [x](std::uint32_t i, std::uint32_t j) {
      return std::array{ x + i, double(j), 0.0 };
    });
  return mesh;
}

/** A torus whose thickness varies along it. */
CoreMesh bumpyTorus(std::uint32_t columns, std::uint32_t rows)
{
  CoreMesh mesh;
  addGrid(mesh, columns, rows, true,
    [columns, rows](std::uint32_t i, std::uint32_t j)
    {
      const double u = 2 * std::numbers::pi * i / columns, v = 2 * std::numbers::pi * j / rows;
      const double radius = 1 + 0.3 * std::sin(5 * u) * std::cos(2 * v);
      const double distance = 4 + radius * std::cos(v);
      return std::array{ distance * std::cos(u), distance * std::sin(u), radius * std::sin(v) };
    });
  return mesh;
}

void append(CoreMesh& mesh, const CoreMesh& other)
{
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t corner : other.corners)
  {
    mesh.corners.push_back(first + corner);
  }
}

std::vector<std::uint32_t> spectral(
  const CoreMesh& mesh, int pageVertices = 256, std::int64_t memory = Memory)
{
  Workspace workspace({}, memory);
  PagedMesh paged = mortonPages(workspace, mesh, pageVertices);
  std::vector<std::string> notes;
  const OrderedVertices order = spectralOrder(paged, workspace, &notes);
  EXPECT_TRUE(notes.empty());
  EXPECT_LE(workspace.pool().peak(), memory);
  std::vector<std::uint32_t> numbers = numbersOf(order);
  EXPECT_EQ(order.count, std::int64_t(numbers.size()));
  return numbers;
}

/** The order must contain each vertex that cells use once. */
void expectPermutation(const CoreMesh& mesh, std::vector<std::uint32_t> order)
{
  std::vector<std::uint32_t> used = mesh.corners;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::ranges::sort(order);
  EXPECT_EQ(order, used);
}

TEST(SpectralOrder, GoesAlongALongPlate)
{
  constexpr std::uint32_t Columns = 1500, Rows = 20;
  const CoreMesh mesh = plate(Columns, Rows);
  std::vector<std::uint32_t> order = spectral(mesh);
  expectPermutation(mesh, order);
  EXPECT_LE(widthOf(mesh, order), 2 * Rows);
  if (order.front() > order.back())
  {
    std::ranges::reverse(order);
  }
  for (std::uint32_t place = 0; place < order.size(); ++place)
  {
    const auto column = double(order[place] / Rows), expected = double(place) / Rows;
    ASSERT_NEAR(column, expected, 8) << "at " << place;
  }
}

TEST(SpectralOrder, IsNarrowerThanABreadthFirstOrder)
{
  const CoreMesh mesh = bumpyTorus(400, 120);
  const std::vector<std::uint32_t> order = spectral(mesh);
  expectPermutation(mesh, order);
  EXPECT_LT(widthOf(mesh, order), 0.85 * double(widthOf(mesh, breadthFirstInCore(mesh))));
}

TEST(SpectralOrder, HoldsForTetrahedra)
{
  // A bar of cubes, each of six tetrahedra.
  constexpr std::uint32_t Length = 200, Side = 8;
  CoreMesh mesh;
  mesh.cornersOfCell = 4;
  const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z)
  { return (x * Side + y) * Side + z; };
  for (std::uint32_t i = 0; i < Length * Side * Side; ++i)
  {
    mesh.points.push_back({ double(i / Side / Side), double(i / Side % Side), double(i % Side) });
  }
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
  {
    const std::uint32_t x = i / Side / Side, y = i / Side % Side, z = i % Side;
    if (x + 1 == Length || y + 1 == Side || z + 1 == Side)
    {
      continue;
    }
    std::array axes{ 0, 1, 2 };
    do
    {
      std::array corner{ x, y, z };
      mesh.corners.push_back(at(x, y, z));
      for (const int axis : axes)
      {
        ++corner[std::size_t(axis)];
        mesh.corners.push_back(at(corner[0], corner[1], corner[2]));
      }
    } while (std::ranges::next_permutation(axes).found);
  }
  const std::vector<std::uint32_t> order = spectral(mesh);
  expectPermutation(mesh, order);
  EXPECT_LE(widthOf(mesh, order), 3 * Side * Side);
}

TEST(SpectralOrder, BringsOneComponentAfterTheOther)
{
  CoreMesh mesh = plate(60, 40);
  mesh.points.push_back({ 5, 5, 5 }); // isolated
  std::vector<std::size_t> ends{ 2400 };
  for (const std::uint32_t size : { 2u, 30u, 3u, 50u, 2u, 9u })
  {
    // Close together so that components share pages and runs.
    append(mesh, plate(size, size, double(mesh.points.size() % 7) / 10));
    ends.push_back(mesh.points.size());
  }
  const std::vector<std::uint32_t> order = spectral(mesh);
  expectPermutation(mesh, order);
  const auto component = [&](std::uint32_t vertex)
  { return std::ranges::upper_bound(ends, vertex) - ends.begin(); };
  int changes = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    changes += component(order[i]) != component(order[i - 1]);
  }
  EXPECT_EQ(changes, 6);
}

TEST(SpectralOrder, HoldsForTinyMeshes)
{
  for (const std::uint32_t columns : { 2u, 3u, 9u, 17u, 33u })
  {
    const CoreMesh mesh = plate(columns, 2);
    const std::vector<std::uint32_t> order = spectral(mesh, 16);
    expectPermutation(mesh, order);
    EXPECT_LE(widthOf(mesh, order), 5);
  }
  Workspace workspace({}, Memory);
  PagedMesh nothing{ VertexPages(workspace, 256, true), {}, {}, 1, 0 };
  nothing.pages.close();
  EXPECT_EQ(spectralOrder(nothing, workspace).count, 0);
}

TEST(SpectralOrder, DoesNotDependOnTheSizeOfPages)
{
  const CoreMesh mesh = bumpyTorus(200, 60);
  for (const int pageVertices : { 7, 64, 100, 5000, 20000 })
  {
    const std::vector<std::uint32_t> order = spectral(mesh, pageVertices);
    expectPermutation(mesh, order);
    EXPECT_LT(widthOf(mesh, order), 220) << pageVertices;
  }
}

TEST(SpectralOrder, NeedsLittleMemory)
{
  // Arrays and graph are larger than their shares of the memory, so that runs consist of pages.
  const CoreMesh mesh = bumpyTorus(1600, 350);
  const std::vector<std::uint32_t> order = spectral(mesh, 32, std::int64_t(MinMebibytes) << 20);
  expectPermutation(mesh, order);
  EXPECT_LT(widthOf(mesh, order), 1000);
}

TEST(SpectralOrder, IsTheAxisOrderWherePagesSayNothing)
{
  const CoreMesh mesh = plate(500, 200);
  const auto neighbours = neighboursOf(mesh);
  std::vector<std::uint32_t> shuffled = mortonOrder(mesh, neighbours);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  Workspace workspace({}, Workspace::MinMemory);
  PagedMesh paged = makePages(workspace, mesh, neighbours, shuffled, 256);
  std::vector<std::string> notes;
  EXPECT_EQ(numbersOf(spectralOrder(paged, workspace, &notes)),
    numbersOf(axisOrder(paged.pages, workspace)));
  ASSERT_EQ(notes.size(), 1);
  EXPECT_NE(notes[0].find("\"axis\""), std::string::npos);
}

} // namespace
} // namespace smg::testing
