// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Simplify.h"

#include "IO/Simplification/SimplifiedMesh.h"
#include "Solver/Core/Timer.h"
#include "Solver/Core/Workers.h"

#include "Testing/IO/SimplifyFixture.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/Sanitized.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"
#include "Testing/Support/Unwelded.h"
#include "smg/VsmReader.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <ranges>
#include <set>
#include <utility>
#include <vector>

// What a simplified surface is, in one window and in parts: vertices of the mesh where they were,
// the topology and the winding of the mesh, an error that is kept, the same bits for all threads.

namespace smg::testing
{
namespace
{

/** A limit with which a window has fewer triangles than the larger meshes. */
constexpr std::int64_t LittleMemory = std::int64_t(16) << 20;

/** A target with options. */
struct Asked : SimplifyTarget, SimplifyOptions
{
};

class Simplify : public SimplifyFixture
{
protected:
  /** Simplifies the mesh, in blocks of so many cells. */
  StreamMesh simplified(const StreamMesh& mesh, const Asked& asked, std::int64_t blockCells = 1000)
  {
    this->Report =
      simplify(MemoryMesh(mesh, blockCells), asked, this->Folder / "simple.vsm", asked);
    const VsmReader reader(this->Folder / "simple.vsm");
    EXPECT_EQ(reader.info().vertices, this->Report.vertices);
    EXPECT_EQ(reader.info().cells, this->Report.cells);
    EXPECT_EQ(this->Report.cells_before, mesh.cells());
    EXPECT_EQ(this->Report.vertices_before, mesh.vertices());
    return collect(*reader.source());
  }
};

Asked toVertices(std::int64_t vertices, std::int64_t memory = std::int64_t(256) << 20)
{
  Asked options;
  options.vertices = vertices;
  options.memoryLimit = memory;
  return options;
}

Asked toError(double error, std::int64_t memory = std::int64_t(256) << 20)
{
  Asked options;
  options.error = error;
  options.memoryLimit = memory;
  return options;
}

const Column& columnOf(const StreamMesh& mesh, const char* name)
{
  return *std::ranges::find(
    mesh.vertexColumns, name, [](const Column& column) { return column.spec.name; });
}

/** Each vertex is that of the mesh whose number it has. */
void expectVerticesOf(const StreamMesh& mesh, const StreamMesh& simple)
{
  const Column& ids = columnOf(simple, OriginalIdName);
  std::set<std::int64_t> seen;
  for (std::int64_t v = 0; v < simple.vertices(); ++v)
  {
    const auto id = static_cast<std::int64_t>(ids.value(static_cast<std::size_t>(v)));
    ASSERT_TRUE(seen.insert(id).second);
    for (std::int64_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(simple.positions[3 * v + axis], mesh.positions[3 * id + axis]);
    }
  }
}

double areaOf(const StreamMesh& mesh)
{
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    const auto point = [&](std::size_t k)
    { return Eigen::Map<const Eigen::Vector3d>(&mesh.positions[3 * mesh.corners[i + k]]); };
    area += 0.5 * (point(1) - point(0)).cross(point(2) - point(0)).norm();
  }
  return area;
}

/** What the edges of a surface tell. */
struct Edges
{
  std::int64_t boundary = 0, turned = 0, branching = 0;
  std::int64_t euler = 0; ///< vertices - edges + triangles
};

Edges edgesOf(const StreamMesh& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<int, int>> uses; // along, against
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int64_t a = mesh.corners[i + k], b = mesh.corners[i + (k + 1) % 3];
      auto& use = uses[std::minmax(a, b)];
      ++(a < b ? use.first : use.second);
    }
  }
  Edges edges;
  for (const auto& [edge, use] : uses)
  {
    const auto& [along, against] = use;
    edges.boundary += along + against == 1 ? 1 : 0;
    edges.turned += along + against == 2 && along != 1 ? 1 : 0;
    edges.branching += along + against > 2 ? 1 : 0;
  }
  edges.euler = mesh.vertices() - static_cast<std::int64_t>(uses.size()) + mesh.cells();
  return edges;
}

/** The boundary, the winding and the handles are those of the mesh. */
void expectSameTopology(const StreamMesh& mesh, const StreamMesh& simple)
{
  const Edges before = edgesOf(mesh), after = edgesOf(simple);
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.turned, 0);
  EXPECT_EQ(after.branching, 0);
  EXPECT_EQ(after.boundary == 0, before.boundary == 0);
}

} // namespace

TEST_F(Simplify, KeepsTheTopologyAndHasSoManyVertices)
{
  const StreamMesh closed = toStream(torus(220, 150, 0.2)), open = toStream(grid(220, 150, 0.1));
  for (const StreamMesh* mesh : { &closed, &open })
  {
    for (const std::int64_t memory : { std::int64_t(256) << 20, LittleMemory })
    {
      for (const std::int64_t vertices : { 100, 3000, 20000 })
      {
        const StreamMesh simple = this->simplified(*mesh, toVertices(vertices, memory));
        EXPECT_LE(simple.vertices(), vertices);
        EXPECT_GE(simple.vertices(), vertices * 9 / 10) << memory;
        expectVerticesOf(*mesh, simple);
        expectSameTopology(*mesh, simple);
        EXPECT_TRUE(this->Report.notes.empty());
      }
    }
  }
}

TEST_F(Simplify, GivesTheSameBitsForAllThreads)
{
  const StreamMesh mesh = toStream(torus(220, 150, 0.2));
  for (const std::int64_t vertices : { 500, 20000 })
  {
    Asked options = toVertices(vertices, LittleMemory);
    options.threads = 1;
    const StreamMesh one = this->simplified(mesh, options);
    const double error = this->Report.error;
    for (const int threads : { 2, 3, 8 })
    {
      options.threads = threads;
      const StreamMesh several = this->simplified(mesh, options);
      EXPECT_EQ(several.corners, one.corners);
      EXPECT_EQ(several.positions, one.positions);
      EXPECT_EQ(this->Report.error, error);
    }
  }
}

TEST_F(Simplify, KeepsAnError)
{
  // A flat mesh needs its corners only, a sphere more the smaller the error is.
  const StreamMesh flat = toStream(grid(200, 150));
  for (const std::int64_t memory : { std::int64_t(256) << 20, LittleMemory })
  {
    const StreamMesh few = this->simplified(flat, toError(1e-4, memory));
    EXPECT_LT(few.vertices(), 1500);
    EXPECT_LE(this->Report.error, 1e-4);
  }
  const StreamMesh ball = toStream(sphere(6));
  for (const std::int64_t memory : { std::int64_t(256) << 20, LittleMemory })
  {
    std::int64_t before = ball.vertices();
    for (const double error : { 3e-4, 1e-3, 1e-2 })
    {
      const StreamMesh simple = this->simplified(ball, toError(error, memory));
      EXPECT_LT(simple.vertices(), before);
      EXPECT_LE(this->Report.error, error);
      EXPECT_GT(this->Report.error, 0.0);
      expectSameTopology(ball, simple);
      before = simple.vertices();
      // The middles of its edges are inside of the sphere by about the error.
      double deepest = 0.0;
      for (std::size_t i = 0; i < simple.corners.size(); ++i)
      {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        double squared = 0.0;
        for (std::int64_t axis = 0; axis < 3; ++axis)
        {
          const double middle = 0.5 * (simple.positions[3 * simple.corners[i] + axis] +
                                        simple.positions[3 * simple.corners[next] + axis]);
          squared += middle * middle;
        }
        deepest = std::max(deepest, 1.0 - std::sqrt(squared));
      }
      EXPECT_LT(deepest, 12.0 * error);
    }
  }
}

TEST_F(Simplify, CarriesTheColumnsOfVertices)
{
  StreamMesh mesh = toStream(torus(220, 150, 0.2));
  std::vector<float> pairs;
  std::vector<std::int64_t> numbers;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    pairs.insert(pairs.end(), { static_cast<float>(v), 0.5F * static_cast<float>(v) });
    numbers.push_back(7 * v);
  }
  mesh.vertexColumns = { makeColumn<float>("Pairs", pairs, 2),
    makeColumn<std::int64_t>(OriginalIdName, numbers) };
  // Of the cells: on which side of the torus they are, twice.
  std::vector<std::int32_t> sides;
  std::vector<float> both;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const double x = mesh.positions[3 * mesh.corners[3 * c]];
    sides.push_back(x < 0.0 ? 7 : 9);
    both.insert(both.end(), { static_cast<float>(sides.back()), 0.5F });
  }
  mesh.cellColumns = { makeColumn<std::int32_t>("Side", sides),
    makeColumn<std::int64_t>(
      OriginalCellIdName, std::vector<std::int64_t>(static_cast<std::size_t>(mesh.cells()))),
    makeColumn<float>("Both", both, 2) };
  for (const std::int64_t vertices : { 500, 20000 })
  {
    const StreamMesh simple = this->simplified(mesh, toVertices(vertices, LittleMemory));
    ASSERT_EQ(simple.vertexColumns.size(), 2U);
    EXPECT_TRUE(this->Report.notes.empty());
    ASSERT_EQ(simple.cellColumns.size(), 2U);
    for (std::size_t c = 0; c < static_cast<std::size_t>(simple.cells()); ++c)
    {
      const double side = simple.cellColumns[0].value(c);
      ASSERT_EQ(simple.cellColumns[1].value(c, 0), side);
      ASSERT_EQ(simple.cellColumns[1].value(c, 1), 0.5);
      double x[3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        x[k] = simple.positions[3 * static_cast<std::size_t>(simple.corners[3 * c + k])];
      }
      // A triangle away from the border has the label of those that were there.
      const auto [low, high] = std::ranges::minmax(x);
      ASSERT_TRUE(low < 0.5 || side == 9) << low;
      ASSERT_TRUE(high > -0.5 || side == 7) << high;
    }
    const Column& ids = columnOf(simple, OriginalIdName);
    for (std::size_t v = 0; v < static_cast<std::size_t>(simple.vertices()); ++v)
    {
      const auto id = static_cast<std::int64_t>(ids.value(v)) / 7;
      ASSERT_EQ(columnOf(simple, "Pairs").value(v, 1), 0.5 * static_cast<double>(id));
      ASSERT_EQ(simple.positions[3 * v], mesh.positions[3 * static_cast<std::size_t>(id)]);
    }
  }
}

TEST_F(Simplify, OfASolidIsItsBoundary)
{
  const StreamMesh solid = toStream(tetBox(30, 25, 20, 0.1));
  const StreamMesh simple = this->simplified(solid, toVertices(200));
  EXPECT_LE(simple.vertices(), 200);
  EXPECT_GE(simple.vertices(), 180);
  expectVerticesOf(solid, simple);
  EXPECT_EQ(edgesOf(simple).euler, 2);
  EXPECT_EQ(edgesOf(simple).boundary, 0);
  EXPECT_TRUE(this->Report.notes.empty());
  StreamMesh labelled = solid;
  const std::vector<std::int32_t> tags(static_cast<std::size_t>(solid.cells()), 3);
  labelled.cellColumns = { makeColumn<std::int32_t>("Material", tags),
    makeColumn<std::int32_t>("Tag", tags) };
  EXPECT_EQ(this->simplified(labelled, toVertices(200)).corners, simple.corners);
  ASSERT_EQ(this->Report.notes.size(), 1U);
  EXPECT_NE(this->Report.notes.front().find("'Material', 'Tag'"), std::string::npos);
}

TEST_F(Simplify, SmallBodiesGoFirstAndAreCounted)
{
  IndexedTestMesh mesh = sphere(5);
  for (int k = 0; k < 100; ++k)
  {
    IndexedTestMesh small = sphere(1);
    for (double& x : small.positions)
    {
      x *= 0.01 + 0.0001 * k;
    }
    mesh = disjointUnion(mesh, small, { 3.0 + k, 0, 0 });
  }
  const StreamMesh simple = this->simplified(toStream(mesh), toVertices(400));
  EXPECT_LE(simple.vertices(), 400);
  EXPECT_EQ(this->Report.dropped_bodies, 101 - 400 / 20);
  EXPECT_EQ(edgesOf(simple).euler, 2 * (400 / 20));
  // The large one keeps nearly all vertices.
  const auto large = std::ranges::count_if(std::views::iota(std::int64_t(0), simple.vertices()),
    [&simple](std::int64_t v) { return simple.positions[3 * v] < 2.0; });
  EXPECT_GT(large, 200);
  ASSERT_EQ(this->Report.notes.size(), 1U);
  EXPECT_NE(this->Report.notes.front().find("81 bodies too small"), std::string::npos);
}

TEST_F(Simplify, ASmallMeshAndOneOfNothingStayAsTheyAre)
{
  const StreamMesh ball = toStream(sphere(2));
  EXPECT_EQ(this->simplified(ball, toVertices(1000)).corners.size(), ball.corners.size());
  IndexedTestMesh point;
  point.positions.assign(9, 1.0);
  point.corners = { 0, 1, 2 };
  EXPECT_EQ(this->simplified(toStream(point), toVertices(100)).cells(), 1);
}

TEST_F(Simplify, OddSurfacesDoNoHarm)
{
  // Triangles that share no vertices, nor their places: their vertices are merged where they are
  // near one another.
  IndexedTestMesh apart = unwelded(sphere(4));
  for (std::size_t i = 0; i < apart.positions.size(); ++i)
  {
    apart.positions[i] += 1e-9 * static_cast<double>(i);
  }
  const StreamMesh soup = toStream(apart);
  const StreamMesh merged = this->simplified(soup, toVertices(300));
  EXPECT_LE(merged.vertices(), 300);
  EXPECT_GT(merged.vertices(), 100);
  EXPECT_GT(this->Report.merged_vertices, soup.vertices() / 2);
  EXPECT_TRUE(std::isnan(this->Report.error)); // of merging
  // Every edge of a fan has three triangles, which are wound against each other.
  IndexedTestMesh fan = grid(40, 40);
  const IndexedTestMesh once = fan;
  for (std::size_t i = 0; i < once.corners.size(); i += 3)
  {
    fan.corners.insert(
      fan.corners.end(), { once.corners[i], once.corners[i + 2], once.corners[i + 1] });
    fan.corners.insert(fan.corners.end(), { once.corners[i], once.corners[i], once.corners[i] });
  }
  EXPECT_LE(this->simplified(toStream(fan), toVertices(200)).vertices(), 200);
}

/** Three pages at a spine, whose vertices cannot go. */
TEST_F(Simplify, SaysWhatIsLostWhereSurfacesBranch)
{
  constexpr int Wide = 20, High = 40;
  IndexedTestMesh pages;
  const auto at = [](int page, int i, int j)
  { return std::int64_t(i == 0 ? j : (page * Wide + i) * (High + 1) + j); };
  for (int row = 0; row <= 3 * Wide; ++row)
  {
    const int page = row == 0 ? 0 : (row - 1) / Wide, i = row - page * Wide;
    const double angle = 2.0943951023931953 * page;
    for (int j = 0; j <= High; ++j)
    {
      pages.positions.insert(
        pages.positions.end(), { i * std::cos(angle), i * std::sin(angle), double(j) });
    }
    for (int j = 0; row > 0 && j < High; ++j)
    {
      const std::int64_t a = at(page, i - 1, j), b = at(page, i, j), c = b + 1,
                         d = at(page, i - 1, j + 1);
      pages.corners.insert(pages.corners.end(), { a, b, c, a, c, d });
    }
  }
  const StreamMesh mesh = toStream(pages);
  for (const std::int64_t vertices : { 10, 25, 40, 43, 47, 100 })
  {
    SCOPED_TRACE(vertices);
    const StreamMesh simple = this->simplified(mesh, toVertices(vertices));
    EXPECT_EQ(this->isSaid("% of the area"), areaOf(simple) < 0.8 * areaOf(mesh));
    EXPECT_EQ(this->isSaid("merged"), vertices <= High);
    EXPECT_EQ(this->Report.merged_vertices > 0, vertices <= High);
    EXPECT_FALSE(this->isSaid("--weld")); // no points coincide
  }
}

/** A triangle on an inner edge, whose ends have as many neighbours as triangles. */
TEST_F(Simplify, KeepsAFinWithinTheError)
{
  IndexedTestMesh fin = grid(3, 3);
  const std::int64_t tip = fin.vertices();
  fin.positions.insert(fin.positions.end(), { 1.5, 1.5, 3.0 });
  fin.corners.insert(fin.corners.end(), { 5, 6, tip });
  for (const double error : { 1e-12, 1e-3, 0.05 })
  {
    simplify(MemoryMesh(toStream(fin)), { .error = error }, this->Folder / "fin.vsm");
    const StreamMesh simple = collect(*VsmReader(this->Folder / "fin.vsm").source());
    double highest = 0.0;
    for (std::size_t i = 2; i < simple.positions.size(); i += 3)
    {
      highest = std::max(highest, simple.positions[i]);
    }
    EXPECT_EQ(highest, 3.0) << error;
  }
}

TEST_F(Simplify, KeepsTheAreaOfAnOpenSurfaceInAnyOrder)
{
  for (const TestOrder order : { TestOrder::BreadthFirst, TestOrder::Keep })
  {
    const StreamMesh mesh = toStream(shuffled(grid(150, 120)), order);
    const StreamMesh simple = this->simplified(mesh, toError(0.01, std::int64_t(64) << 20));
    EXPECT_LT(simple.vertices(), 1200);
    EXPECT_NEAR(areaOf(simple), areaOf(mesh), 0.002 * areaOf(mesh));
  }
}

TEST_F(Simplify, ASolidInLittleMemoryIsThatOfMuch)
{
  const StreamMesh solid = toStream(tetBox(45, 40, 35, 0.1));
  for (const Asked& options : { toVertices(4000, LittleMemory), toError(0.02, LittleMemory) })
  {
    const StreamMesh simple = this->simplified(solid, options);
    EXPECT_EQ(edgesOf(simple).euler, 2);
    EXPECT_EQ(edgesOf(simple).boundary, 0);
    EXPECT_EQ(edgesOf(simple).branching, 0);
    EXPECT_TRUE(this->Report.notes.empty());
    EXPECT_GE(simple.vertices(), options.vertices * 9 / 10);
  }
}

TEST_F(Simplify, BodiesOfOneSizeAreBodies)
{
  IndexedTestMesh mesh = sphere(2);
  for (int k = 1; k < 60; ++k)
  {
    mesh = disjointUnion(mesh, sphere(2), { 3.0 * k, 0, 0 });
  }
  const StreamMesh many = toStream(mesh);
  EXPECT_EQ(this->simplified(many, toVertices(600)).vertices(), 600);
  EXPECT_EQ(this->Report.dropped_bodies, 30);
  // An error keeps all of them.
  Asked both = toVertices(600);
  both.error = 1e9;
  const StreamMesh kept = this->simplified(many, both);
  EXPECT_EQ(this->Report.dropped_bodies, 0);
  EXPECT_LE(kept.vertices(), 600);
  EXPECT_EQ(edgesOf(kept).euler, 120);
}

TEST_F(Simplify, CellsWithoutAreaStayConnected)
{
  StreamMesh mesh = toStream(grid(20, 20));
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()), 0);
  flags[300] = DegenerateCell;
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  EXPECT_EQ(this->simplified(mesh, toVertices(1000)).cells(), mesh.cells());
}

TEST_F(Simplify, AHubOfManyTrianglesTakesNoSquareOfTheirNumber)
{
  IndexedTestMesh fan;
  fan.positions = { 0, 0, 0 };
  constexpr int Rim = 40000;
  for (int k = 0; k < Rim; ++k)
  {
    const double angle = 6.283185307179586 * k / Rim, radius = 1.0 + 0.1 * (k % 2);
    fan.positions.insert(
      fan.positions.end(), { radius * std::cos(angle), radius * std::sin(angle), 0.0 });
    fan.corners.insert(fan.corners.end(), { 0, 1 + k, 1 + (k + 1) % Rim });
  }
  EXPECT_LE(this->simplified(toStream(fan), toVertices(2000)).vertices(), 2000);
}

TEST_F(Simplify, VerticesOfTheStreamBecomeFinal)
{
  const StreamMesh mesh = toStream(torus(300, 200, 0.2));
  MemorySource source(mesh, 1000);
  Workers workers(1);
  SimplifiedMesh simple(source, false, { .vertices = 40000 }, LittleMemory, workers, {});
  std::int64_t blocks = 0, open = 0;
  for (MeshBlock block; simple.next(block); ++blocks)
  {
    open = std::max(open, simple.info().vertices - block.finalized);
  }
  EXPECT_GT(blocks, 3);
  EXPECT_LT(open, 4000);
}

TEST_F(Simplify, AWideStreamNeedsMoreMemory)
{
  // No vertex is final before the end.
  StreamMesh mesh = toStream(shuffled(torus(300, 200, 0.2)), TestOrder::Keep);
  EXPECT_LE(this->simplified(mesh, toVertices(1000, std::int64_t(64) << 20)).vertices(), 1000);
  expectError([&] { this->simplified(mesh, toVertices(1000, LittleMemory)); },
    "raise the memory limit, or convert the mesh with the order bfs if it has another");
}

TEST_F(Simplify, RefusesOptionsOutOfRangeAndCanBeCancelled)
{
  const StreamMesh mesh = toStream(torus(50, 40));
  expectError([&] { this->simplified(mesh, {}); }, "needs the number of vertices or the error");
  expectError([&] { this->simplified(mesh, toVertices(3)); }, "expected 4 to 1099511627776");
  expectError([&] { this->simplified(mesh, toVertices(SimplifyTarget::MaxVertices + 1)); },
    "expected 4 to 1099511627776");
  expectError([&] { this->simplified(mesh, toError(-1.0)); }, "expected a length above 0");
  expectError([&] { this->simplified(mesh, toError(std::nan(""))); }, "expected a length above 0");
  expectError([&] { this->simplified(mesh, toVertices(100, (16 << 20) - 1)); },
    "a simplification needs a memory limit of at least 16 MiB, but it is 15 MiB");
  Asked options = toVertices(100);
  for (const double end : { 0.0, 0.5, 1.0 })
  {
    options.progress = [end](double done) { return done < end; };
    EXPECT_THROW(this->simplified(mesh, options), Cancelled);
    EXPECT_FALSE(std::filesystem::exists(this->Folder / "simple.vsm"));
  }
}

TEST_F(Simplify, AsksAtShortIntervalsWhetherToGoOn)
{
  if (Sanitized)
  {
    GTEST_SKIP() << "here a system call may take as long as a loop";
  }
  // In shares of the processor time: a loop that does not ask takes a tenth of it. One thread asks
  // at the same places each time, and other programs seldom delay it twice at one of them.
  const StreamMesh mesh = toStream(torus(700, 400, 0.2));
  Asked options = toVertices(1000, std::int64_t(1) << 30);
  options.threads = 1;
  std::vector<double> shortest;
  for (int run = 0; run < 3; ++run)
  {
    std::vector<double> asked;
    options.progress = [&](double)
    {
      asked.push_back(processSeconds());
      return true;
    };
    this->simplified(mesh, options, 20000);
    shortest.resize(asked.size() - 1, std::numeric_limits<double>::infinity());
    ASSERT_GT(shortest.size(), 100U);
    for (std::size_t i = 0; i < shortest.size(); ++i)
    {
      shortest[i] = std::min(shortest[i], asked[i + 1] - asked[i]);
    }
  }
  const double whole = std::accumulate(shortest.begin(), shortest.end(), 0.0);
  EXPECT_LT(std::ranges::max(shortest), 0.06 * whole);
}

} // namespace smg::testing
