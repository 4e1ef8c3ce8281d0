// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/DistanceTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/NotNumbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

// Meshes that are not reached, not valid or not connected, and descriptions that are not valid.

namespace smg::testing
{

TEST(DistanceErrors, ComponentsWithoutSourceAreInfinite)
{
  const IndexedTestMesh square = unitSquare(20);
  const MemoryMesh mesh(toStream(disjointUnion(square, square, { 2, 0, 0 })));
  DistanceDescription description = fromVertices({ nearestTo(mesh.mesh(), 0.5, 0.5, 0) });
  description.source = description.direction = true;
  const Solved solved = measure(mesh, description);
  EXPECT_EQ(solved.report.distance->unreached, square.vertices());
  EXPECT_LT(solved.report.distance->maximum, 1.0);
  EXPECT_TRUE(solved.report.converged);
  for (std::int64_t v = 0; v < mesh.mesh().vertices(); ++v)
  {
    const bool isReached = mesh.mesh().positions[3 * v] <= 1;
    EXPECT_EQ(std::isfinite(solved.values(v, 0)), isReached);
    EXPECT_EQ(solved.values(v, 1) >= 0, isReached);
    EXPECT_EQ(solved.values.row(v).tail(3).norm() > 0.5, isReached && solved.values(v, 0) > 0);
  }
}

TEST(DistanceErrors, DuplicatesHaveNoPart)
{
  StreamMesh strip = toStream(grid(3, 40), TestOrder::Keep);
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(strip.cells()));
  std::fill_n(flags.begin() + strip.cells() / 2, 8, DuplicateCell);
  strip.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  const MemoryMesh mesh(strip);
  const Solved solved = measure(mesh, fromVertices({ 0 }));
  EXPECT_GT(solved.report.distance->unreached, strip.vertices() / 3);
  EXPECT_EQ(solved.report.degenerate_cells, 8);
}

TEST(DistanceErrors, CellsWithoutAreaJoinWhatTheyTouch)
{
  // The square in two halves, the upper one with the edges of the seam halved: triangles without
  // area between the halves close it.
  constexpr int N = 20;
  IndexedTestMesh square;
  std::vector<std::uint8_t> flags;
  const auto addRow = [&square](int parts, double y)
  {
    const std::int64_t first = square.vertices();
    for (int i = 0; i <= parts; ++i)
    {
      square.positions.insert(square.positions.end(), { double(i) / parts, y, 0.0 });
    }
    return first;
  };
  const auto addStrip = [&square](std::int64_t below, std::int64_t above, int parts)
  {
    for (int i = 0; i < parts; ++i)
    {
      const std::int64_t a = below + i, c = above + i;
      square.corners.insert(square.corners.end(), { a, a + 1, c, a + 1, c + 1, c });
    }
  };
  std::int64_t below = addRow(N, 0);
  for (int k = 1; k <= N / 2; ++k)
  {
    const std::int64_t row = addRow(N, double(k) / N);
    addStrip(below, row, N);
    below = row;
  }
  std::int64_t above = addRow(2 * N, 0.5);
  flags.resize(static_cast<std::size_t>(square.cells()));
  for (int i = 0; i < N; ++i)
  {
    const std::int64_t a = below + i, c = above + 2 * i;
    square.corners.insert(
      square.corners.end(), { a, a + 1, c + 1, a, c + 1, c, a + 1, c + 2, c + 1 });
  }
  flags.resize(static_cast<std::size_t>(square.cells()), DegenerateCell);
  for (int k = 1; k <= N; ++k)
  {
    const std::int64_t row = addRow(2 * N, 0.5 + 0.5 * k / N);
    addStrip(above, row, 2 * N);
    above = row;
  }
  flags.resize(static_cast<std::size_t>(square.cells()));
  StreamMesh stream = toStream(square, TestOrder::Keep);
  stream.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  const MemoryMesh mesh(stream);
  const std::int64_t source = nearestTo(mesh.mesh(), 0.3, 0.2, 0);
  const Solved solved = measure(mesh, fromVertices({ source }));
  EXPECT_EQ(solved.report.distance->unreached, 0);
  EXPECT_EQ(solved.report.degenerate_cells, 0);
  const RelativeErrors errors = errorsOf(solved, mesh.mesh(), straightFrom(mesh.mesh(), source));
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(DistanceErrors, DegenerateCellsAreHarmless)
{
  IndexedTestMesh square = unitSquare(20);
  const IndexedTestMesh sound = square;
  for (std::int64_t c = 0; c < 300; c += 3)
  {
    // A repeated corner, no area, and the same cell again.
    square.corners.insert(square.corners.end(), { c, c, c + 1 });
    square.corners.insert(square.corners.end(),
      { square.corners[3 * c], square.corners[3 * c + 1], square.corners[3 * c + 2] });
  }
  square.corners.insert(square.corners.end(), { 0, 1, 2 });
  const MemoryMesh mesh(toStream(square));
  const std::int64_t source = nearestTo(mesh.mesh(), 0.3, 0.2, 0);
  const RelativeErrors errors = errorsOf(
    measure(mesh, fromVertices({ source })), mesh.mesh(), straightFrom(mesh.mesh(), source));
  EXPECT_LT(errors.largest, 1e-6);
}

TEST(DistanceErrors, CoincidentVerticesHaveOneDistance)
{
  // Two vertices in the same place, joined by a triangle without area.
  IndexedTestMesh mesh{ .positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0 },
    .corners = { 0, 1, 2, 1, 2, 3, 1, 4, 3 } };
  const Solved solved = measure(MemoryMesh(toStream(mesh, TestOrder::Keep)), fromVertices({ 0 }));
  EXPECT_DOUBLE_EQ(solved.values(2, 0), 1.0);
  EXPECT_DOUBLE_EQ(solved.values(3, 0), 1.0);
  EXPECT_NEAR(solved.values(4, 0), std::sqrt(2.0), 1e-9);
}

TEST(DistanceErrors, NameTheSource)
{
  const MemoryMesh mesh(toStream(unitSquare(4)));
  expectError([&] { measure(mesh, {}); }, "distance: a distance needs at least one source.");
  expectError(
    [&] {
      measure(mesh, fromVertices({ 1, 77 }));
    },
    "distance: from[0].vertices: the mesh has no vertex with the original number 77");
  DistanceDescription far;
  far.from.emplace_back(NearestVertices{ { { 0, 0, 0 } } });
  far.from.emplace_back(Region(Region::Sphere{ { 9, 9, 9 }, 1 }));
  expectError(
    [&] { measure(mesh, far); }, "distance: from[1]: no vertex of the mesh is in this region.");
  DistanceDescription column;
  column.from.emplace_back(ColumnMask{ "Inlet" });
  expectError([&] { measure(mesh, column); }, "from[0].mask: the mesh has no column 'Inlet'");
}

TEST(DistanceErrors, OptionsHaveRanges)
{
  const MemoryMesh mesh(toStream(unitSquare(4)));
  const auto with = [&](auto change)
  {
    DistanceOptions options;
    change(options);
    return messageOf([&] { measure(mesh, fromVertices({ 0 }), options); });
  };
  EXPECT_NE(with([](auto& options) { options.memoryLimit = 0; }), "");
  EXPECT_NE(with([](auto& options) { options.threads = -1; }), "");
  EXPECT_NE(with([](auto& options) { options.maxPasses = 0; }), "");
  EXPECT_EQ(with([](auto& options) { options.maxPasses = 1; }), "");
}

TEST(DistanceErrors, MeshesAreChecked)
{
  for (const double bad : { NotANumber, Infinite })
  {
    StreamMesh mesh = toStream(unitSquare(4));
    mesh.positions[7] = bad;
    expectError([&] { measure(MemoryMesh(mesh), fromVertices({ 0 })); }, "is not a finite number");
  }
  expectError([] { measure(MemoryMesh(StreamMesh()), fromVertices({ 0 })); }, "distance");
  MemoryMesh narrow(toStream(unitSquare(9)));
  narrow.info().span = 2;
  expectError([&] { measure(narrow, fromVertices({ 0 })); }, "its span is said to be 2");
  for (const double scale : { 1e-70, 1e80 })
  {
    StreamMesh mesh = toStream(unitSquare(4));
    std::ranges::for_each(mesh.positions, [scale](double& x) { x *= scale; });
    expectError([&] { measure(MemoryMesh(mesh), fromVertices({ 0 })); }, "extent of the mesh");
  }
}

} // namespace smg::testing
