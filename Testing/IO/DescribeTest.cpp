// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Describe.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

// Descriptions against a brute force that has the whole mesh in memory and shares no code with
// them, on meshes with every defect; that blocks change nothing; and the memory that they need.

namespace smg::testing
{
namespace
{

using Facet = std::vector<std::int64_t>;

/** The number of groups that pairs connect. */
template <class Item>
std::int64_t groups(const std::set<Item>& items, const std::vector<std::pair<Item, Item>>& pairs)
{
  std::map<Item, Item> label;
  for (const Item& item : items)
  {
    label[item] = item;
  }
  for (bool changes = true; changes;)
  {
    changes = false;
    for (const auto& [a, b] : pairs)
    {
      Item least = std::min(label[a], label[b]);
      changes = changes || label[a] != label[b];
      label[a] = label[b] = least;
    }
  }
  std::set<Item> different;
  for (const auto& [item, least] : label)
  {
    different.insert(least);
  }
  return static_cast<std::int64_t>(different.size());
}

/** The counts of a mesh, straight from their definitions. */
struct Brute
{
  explicit Brute(const StreamMesh& mesh)
    : Corners(static_cast<std::size_t>(cornersOf(mesh.cellType)))
  {
    for (std::size_t c = 0; c < mesh.corners.size(); c += this->Corners)
    {
      this->addCell({ mesh.corners.begin() + std::ptrdiff_t(c),
        mesh.corners.begin() + std::ptrdiff_t(c + this->Corners) });
    }
    this->countBodies();
    for (const auto& [facet, cells] : this->CellsOf)
    {
      this->nonManifoldFacets += cells > 2 ? 1 : 0;
      if (cells == 1)
      {
        this->Boundary.push_back(facet);
      }
    }
    this->boundaryFacets = static_cast<std::int64_t>(this->Boundary.size());
    this->boundaryParts = partsOf(this->Boundary);
    this->countTriangles(this->Corners == 3 ? this->Triangles : this->Boundary);
  }

  std::int64_t bodies = 0, boundaryFacets = 0, boundaryParts = 0, nonManifoldFacets = 0;
  std::int64_t nonManifoldEdges = 0, nonManifoldVertices = 0, turnedEdges = 0, repeated = 0;
  bool balanced = true;

private:
  void addCell(const Facet& cell)
  {
    this->Cells.push_back(cell);
    if (std::set(cell.begin(), cell.end()).size() < this->Corners)
    {
      ++this->repeated;
      return;
    }
    for (std::size_t k = 0; k < this->Corners; ++k)
    {
      Facet facet = cell;
      facet.erase(facet.begin() + std::ptrdiff_t(k));
      std::ranges::sort(facet);
      ++this->CellsOf[facet];
    }
    if (this->Corners == 3)
    {
      this->Triangles.push_back(cell);
    }
  }

  static std::int64_t partsOf(const std::vector<Facet>& facets)
  {
    std::set<std::int64_t> vertices;
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    for (const Facet& facet : facets)
    {
      for (const std::int64_t v : facet)
      {
        vertices.insert(v);
        pairs.emplace_back(facet.front(), v);
      }
    }
    return groups(vertices, pairs);
  }

  void countBodies() { this->bodies = partsOf(this->Cells); }

  /** The edges and vertices of some triangles. */
  void countTriangles(const std::vector<Facet>& triangles)
  {
    std::map<std::pair<std::int64_t, std::int64_t>, std::array<int, 2>> runs; // up and down
    std::map<std::int64_t, std::vector<Facet>> around;
    for (const Facet& t : triangles)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int64_t a = t[k], b = t[(k + 1) % 3];
        ++runs[std::minmax(a, b)][a < b ? 0 : 1];
        around[a].push_back({ b, t[(k + 2) % 3] });
      }
    }
    for (const auto& [edge, run] : runs)
    {
      this->nonManifoldEdges += run[0] + run[1] > 2 ? 1 : 0;
      this->turnedEdges += run[0] + run[1] == 2 && run[0] != 1 ? 1 : 0;
      this->balanced = this->balanced && run[0] == run[1];
    }
    for (const auto& [vertex, others] : around)
    {
      this->nonManifoldVertices += partsOf(others) > 1 ? 1 : 0;
    }
  }

  std::size_t Corners;
  std::vector<Facet> Cells, Triangles, Boundary;
  std::map<Facet, int> CellsOf;
};

/** Removes, repeats, turns and flattens cells, and joins vertices. */
IndexedTestMesh damaged(IndexedTestMesh mesh, std::uint64_t seed)
{
  Random random(seed);
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const auto someCell = [&] { return std::size_t(random.below(mesh.cells())) * corners; };
  for (std::int64_t k = random.below(mesh.cells()); k > 0; --k)
  {
    const std::size_t c = someCell();
    mesh.corners.erase(
      mesh.corners.begin() + std::ptrdiff_t(c), mesh.corners.begin() + std::ptrdiff_t(c + corners));
  }
  for (std::int64_t k = random.below(4); k > 0; --k)
  {
    const std::size_t c = someCell();
    const std::vector cell(
      mesh.corners.begin() + std::ptrdiff_t(c), mesh.corners.begin() + std::ptrdiff_t(c + corners));
    mesh.corners.insert(mesh.corners.end(), cell.begin(), cell.end());
  }
  for (std::int64_t k = random.below(4); k > 0; --k)
  {
    const std::size_t c = someCell();
    std::swap(mesh.corners[c], mesh.corners[c + 1]);
  }
  for (std::int64_t k = random.below(4); k > 0; --k)
  {
    const std::int64_t from = random.below(mesh.vertices()), to = random.below(mesh.vertices());
    std::ranges::replace(mesh.corners, from, to);
  }
  for (std::int64_t k = random.below(3); k > 0; --k)
  {
    const std::size_t c = someCell();
    std::copy_n(mesh.positions.begin() + std::ptrdiff_t(3 * mesh.corners[c]), 3,
      mesh.positions.begin() + std::ptrdiff_t(3 * mesh.corners[c + 1]));
  }
  return mesh;
}

IndexedTestMesh someMesh(std::uint64_t seed)
{
  Random random(seed);
  switch (seed % 4)
  {
    case 0:
      return disjointUnion(sphere(1), torus(5, 4, 0.3), { 5, 0, 0 });
    case 1:
      return grid(3 + int(random.below(6)), 3 + int(random.below(6)), 0.1);
    case 2:
      return tetBox(2 + int(random.below(3)), 3, 2 + int(random.below(3)), 0.1);
    default:
      return disjointUnion(tetBox(3, 2, 3), tetBox(2, 2, 2), { 9, 0, 0 });
  }
}

MeshDescription described(const StreamMesh& mesh, std::int64_t blockCells = 1000)
{
  return describe(MemoryMesh(mesh, blockCells));
}

} // namespace

TEST(Describe, CountsWhatABruteForceCounts)
{
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    SCOPED_TRACE(seed);
    const StreamMesh mesh = toStream(shuffled(damaged(someMesh(seed), seed), seed),
      seed % 3 == 0 ? TestOrder::Keep : TestOrder::BreadthFirst);
    const Brute brute(mesh);
    const MeshDescription found = described(mesh, 1 + std::int64_t(seed % 7));
    ASSERT_EQ(found.vertices, mesh.vertices());
    ASSERT_EQ(found.cells, mesh.cells());
    ASSERT_EQ(found.bodies, brute.bodies);
    ASSERT_EQ(found.boundary_facets, brute.boundaryFacets);
    ASSERT_EQ(found.boundary_parts, brute.boundaryParts);
    ASSERT_EQ(found.nonmanifold_facets, brute.nonManifoldFacets);
    ASSERT_EQ(found.nonmanifold_edges, brute.nonManifoldEdges);
    ASSERT_EQ(found.nonmanifold_vertices, brute.nonManifoldVertices);
    ASSERT_GE(found.degenerate_cells, brute.repeated);
    if (mesh.cellType == CellType::Triangle)
    {
      ASSERT_EQ(found.turned_edges, brute.turnedEdges);
      ASSERT_EQ(found.consistently_wound, brute.turnedEdges == 0);
      ASSERT_EQ(found.closed, brute.boundaryFacets == 0);
      ASSERT_EQ(std::isnan(found.volume), !brute.balanced);
    }
  }
}

/** Whatever the blocks are, and so the text. */
TEST(Describe, DoesNotDependOnBlocks)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    StreamMesh mesh = toStream(damaged(someMesh(seed), seed));
    Random random(seed);
    std::vector<double> values(std::size_t(mesh.vertices()));
    std::ranges::generate(values, [&] { return random.uniform(-1, 1); });
    mesh.vertexColumns = { makeColumn<double>("v", values) };
    // All memory is that of windows, which blocks change.
    const auto text = [&](std::int64_t blockCells)
    {
      MeshDescription found = described(mesh, blockCells);
      found.pool_bytes_peak = 0;
      return found.json();
    };
    const std::string whole = text(100000);
    EXPECT_EQ(text(1), whole);
    EXPECT_EQ(text(3), whole);
    EXPECT_EQ(text(64), whole);
  }
}

TEST(Describe, CountsAsTheConversionDoes)
{
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE(seed);
    const IndexedTestMesh mesh = damaged(someMesh(seed), seed);
    const auto file = folder.path() / "mesh.mesh";
    writeBytes(file, meshText(mesh));
    const auto converted = openMesh(file);
    const ConversionReport& report = *converted->conversion();
    const MeshDescription found = describe(*converted);
    EXPECT_EQ(found.bodies, report.components);
    EXPECT_EQ(found.degenerate_cells, report.degenerate_cells);
    EXPECT_EQ(found.duplicate_cells, report.duplicate_cells);
    EXPECT_EQ(found.isolated_vertices, report.isolated_vertices);
    if (mesh.cellType == CellType::Triangle)
    {
      EXPECT_EQ(found.boundary_facets, report.boundary_edges);
      EXPECT_EQ(found.nonmanifold_edges, report.nonmanifold_edges);
      EXPECT_EQ(found.nonmanifold_vertices, report.nonmanifold_vertices);
    }
    else
    {
      EXPECT_EQ(found.inverted_cells, report.inverted_cells);
    }
  }
}

TEST(Describe, MeasuresASphereATorusAndABox)
{
  const MeshDescription ball = described(toStream(sphere(5)));
  EXPECT_TRUE(ball.closed);
  EXPECT_TRUE(ball.consistently_wound);
  EXPECT_NEAR(ball.area, 4.0 * std::numbers::pi, 0.01);
  EXPECT_NEAR(ball.volume, 4.0 / 3.0 * std::numbers::pi, 0.01);
  EXPECT_EQ(ball.turned_volume, 0.0);
  EXPECT_NEAR(ball.diagonal, std::sqrt(12.0), 1e-12);
  EXPECT_GT(ball.quality.minimum, 0.8);
  EXPECT_EQ(ball.quality.slivers, 0);
  EXPECT_LT(ball.edge_length.minimum, ball.edge_length.mean);
  EXPECT_LT(ball.edge_length.mean, ball.edge_length.maximum);

  // All triangles of the grid are equilateral with sides of 1.
  const MeshDescription sheet = described(toStream(grid(10, 8)));
  EXPECT_FALSE(sheet.closed);
  EXPECT_EQ(sheet.boundary_facets, 2 * (9 + 7));
  EXPECT_EQ(sheet.boundary_parts, 1);
  EXPECT_NEAR(sheet.boundary_length, 32.0, 1e-12);
  EXPECT_NEAR(sheet.quality.minimum, 1.0, 1e-12);
  EXPECT_NEAR(sheet.quality.mean, 1.0, 1e-12);
  EXPECT_NEAR(sheet.edge_length.minimum, 1.0, 1e-12);
  EXPECT_NEAR(sheet.edge_length.maximum, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(sheet.volume));

  const MeshDescription box = described(toStream(tetBox(5, 4, 3)));
  EXPECT_NEAR(box.volume, 24.0, 1e-12);
  EXPECT_NEAR(box.area, 2.0 * (4 * 3 + 4 * 2 + 3 * 2), 1e-12);
  EXPECT_EQ(box.boundary_facets, 4 * (4 * 3 + 4 * 2 + 3 * 2));
  EXPECT_EQ(box.boundary_parts, 1);
  EXPECT_EQ(box.nonmanifold_edges, 0);
  EXPECT_EQ(box.nonmanifold_vertices, 0);
  EXPECT_EQ(box.inverted_cells, 0);

  // The regular tetrahedron.
  const MeshDescription one = described(toStream(
    { CellType::Tetrahedron, { 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1 }, { 0, 1, 2, 3 } }));
  EXPECT_NEAR(one.quality.minimum, 1.0, 1e-12);
}

/** Two boxes side by side, each with its own copy of the faces between them; and one whose cells
 * share them. */
TEST(Describe, FacesThatBodiesHaveACopyOfEachAreCounted)
{
  StreamMesh boxes = toStream(disjointUnion(tetBox(4, 5, 3), tetBox(4, 5, 3), { 3.0, 0.0, 0.0 }));
  boxes.groups.groups = { { "chip", 1, GroupOf::Cells }, { "sink", 2, GroupOf::Cells } };
  boxes.groups.sets = { {}, { 0 }, { 1 } };
  std::vector<GroupSet> sets;
  for (std::int64_t c = 0; c < boxes.cells(); ++c)
  {
    double middle = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      middle += boxes.positions[3 * static_cast<std::size_t>(boxes.corners[4 * c + k])] / 4.0;
    }
    sets.push_back(middle < 3.0 ? 1 : 2);
  }
  boxes.cellColumns.push_back(makeColumn<GroupSet>(CellGroupsName, sets));
  const MeshDescription apart = described(boxes);
  EXPECT_EQ(apart.bodies, 2);
  EXPECT_EQ(apart.coincident_facets, 2 * 4 * 2);
  ASSERT_EQ(apart.notes.size(), 1U);
  EXPECT_EQ(apart.notes[0],
    "16 faces of the boundary lie on others: 16 between 'chip' and 'sink': bodies are "
    "not connected there, unless these points are merged (option --weld).");
  EXPECT_EQ(described(toStream(tetBox(7, 5, 3))).coincident_facets, 0);
}

TEST(Describe, ACavityCountsAsTurnedVolume)
{
  IndexedTestMesh hole = sphere(3);
  for (std::size_t k = 0; k < hole.corners.size(); k += 3)
  {
    std::swap(hole.corners[k], hole.corners[k + 1]);
  }
  for (double& x : hole.positions)
  {
    x *= 0.5;
  }
  const MeshDescription shell = described(toStream(disjointUnion(sphere(3), hole)));
  EXPECT_EQ(shell.bodies, 2);
  EXPECT_TRUE(shell.closed);
  const double whole = described(toStream(sphere(3))).volume;
  EXPECT_NEAR(shell.volume, whole * 7.0 / 8.0, 1e-12);
  EXPECT_NEAR(shell.turned_volume, whole / 8.0, 1e-12);
}

/** A membrane in a box, once in each direction: the second one is a duplicate, but without it the
 * first one would count. */
TEST(Describe, AMembraneOfTwoDuplicatesEnclosesNothing)
{
  IndexedTestMesh mesh = sphere(2);
  const double before = described(toStream(mesh)).volume;
  mesh.corners.insert(mesh.corners.end(), { 0, 1, 2, 0, 2, 1 });
  StreamMesh stream = toStream(mesh, TestOrder::Keep);
  std::vector<std::uint8_t> flags(std::size_t(stream.cells()));
  flags.back() = DuplicateCell;
  stream.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  const MeshDescription found = described(stream);
  EXPECT_EQ(found.duplicate_cells, 1);
  EXPECT_NEAR(found.volume, before, 1e-12);
}

/** Each has an angle above, or below, the limit of the solver. */
TEST(Describe, ASliverHasAnAngleOfMoreThan166Degrees)
{
  const auto sliversOf = [](double angle)
  {
    const double half = angle / 2.0 * std::numbers::pi / 180.0;
    const IndexedTestMesh triangle{ CellType::Triangle,
      { -1, 0, 0, 1, 0, 0, 0, 1.0 / std::tan(half), 0 }, { 0, 1, 2 } };
    // The dihedral angle at the edge from 0 to 1.
    const double s = std::sin(half), c = std::cos(half);
    const IndexedTestMesh tetrahedron{ CellType::Tetrahedron,
      { 0, 0, -0.5, 0, 0, 0.5, s, c, 0, -s, c, 0 }, { 0, 1, 2, 3 } };
    return std::array{ described(toStream(triangle)).quality.slivers,
      described(toStream(tetrahedron)).quality.slivers };
  };
  EXPECT_EQ(sliversOf(165.9), (std::array<std::int64_t, 2>{ 0, 0 }));
  EXPECT_EQ(sliversOf(166.1), (std::array<std::int64_t, 2>{ 1, 1 }));
}

TEST(Describe, FlawedCellsAreCountedApart)
{
  // A triangle twice, one with two vertices at a place, one with a corner twice, one on a line.
  StreamMesh mesh = toStream({ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 2, 0, 0 },
                               { 0, 1, 2, 0, 1, 2, 1, 2, 3, 1, 1, 3, 0, 1, 4 } },
    TestOrder::Keep);
  mesh.cellColumns = { makeColumn<std::uint8_t>(
    CellFlagsName, std::array<std::uint8_t, 5>{ 0, DuplicateCell, 0, 0, 0 }) };
  const MeshDescription found = described(mesh);
  EXPECT_EQ(found.degenerate_cells, 3);
  EXPECT_EQ(found.coincident_cells, 1);
  EXPECT_EQ(found.duplicate_cells, 1);
  EXPECT_EQ(found.area, 0.5);
  EXPECT_EQ(found.edge_length.minimum, 0.0);
  EXPECT_EQ(found.bodies, 1);
}

TEST(Describe, ColumnsHaveRangesAndTags)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double Infinite = std::numeric_limits<double>::infinity();
  constexpr std::int64_t Large = (std::int64_t(1) << 62) + 1;
  StreamMesh mesh = toStream(grid(3, 2));
  ASSERT_EQ(mesh.vertices(), 6);
  ASSERT_EQ(mesh.cells(), 4);
  mesh.vertexColumns = {
    makeColumn<double>(
      "pair", std::array{ 1.0, NaN, 2.0, 5.0, Infinite, -3.0, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0 }, 2),
    makeColumn<float>(
      "none", std::array{ float(NaN), float(NaN), float(NaN), float(NaN), float(NaN), float(NaN) }),
    makeColumn<std::int64_t>(
      "large", std::array<std::int64_t, 6>{ Large, Large, -Large, Large, 3, 3 })
  };
  mesh.cellColumns = { makeColumn<std::uint64_t>(
    "tag", std::array<std::uint64_t, 4>{ 7, std::uint64_t(-1), 7, 7 }) };
  for (const std::int64_t blockCells : { 1, 100 })
  {
    const nlohmann::json columns =
      nlohmann::json::parse(described(mesh, blockCells).json())["columns"];
    const nlohmann::json& of = columns["vertices"];
    EXPECT_EQ(of[0]["minimum"], (nlohmann::json{ 0.5, -3.0 }));
    EXPECT_EQ(of[0]["maximum"], (nlohmann::json{ 2.0, 5.0 }));
    EXPECT_EQ(of[0]["not_finite"], 2);
    EXPECT_FALSE(of[0].contains("tags"));
    EXPECT_EQ(of[1]["minimum"], nlohmann::json::array({ nullptr }));
    EXPECT_EQ(of[1]["not_finite"], 6);
    EXPECT_EQ(of[2]["minimum"], nlohmann::json::array({ -Large }));
    EXPECT_EQ(of[2]["maximum"], nlohmann::json::array({ Large }));
    EXPECT_EQ(of[2]["tags"][std::to_string(Large)], 3);
    EXPECT_EQ(of[2]["tags"]["3"], 2);
    EXPECT_EQ(
      columns["cells"][0]["tags"], (nlohmann::json{ { "7", 3 }, { "18446744073709551615", 1 } }));
  }
}

TEST(Describe, TagsAreAtMost64)
{
  StreamMesh mesh = toStream(grid(20, 20));
  for (const std::int32_t different : { 64, 65 })
  {
    std::vector<std::int32_t> values(std::size_t(mesh.vertices()));
    std::iota(values.begin(), values.end(), 0);
    std::ranges::for_each(values, [&](std::int32_t& value) { value = value * 37 % different; });
    mesh.vertexColumns = { makeColumn<std::int32_t>("tag", values) };
    const auto tags = described(mesh, 7).vertex_columns.front().tags;
    EXPECT_EQ(tags.size(), different == 64 ? 64U : 0U);
    std::int64_t count = 0;
    for (const MeshDescription::Tag& tag : tags)
    {
      count += tag.count;
    }
    EXPECT_EQ(count, different == 64 ? mesh.vertices() : 0);
  }
}

/** Each triangle has vertices of its own: a body for each, and a note on it. */
TEST(Describe, ASoupIsManyBodies)
{
  const IndexedTestMesh welded = sphere(3);
  IndexedTestMesh soup;
  for (const std::int64_t corner : welded.corners)
  {
    soup.corners.push_back(soup.vertices());
    soup.positions.insert(soup.positions.end(), welded.positions.begin() + 3 * corner,
      welded.positions.begin() + 3 * corner + 3);
  }
  const MeshDescription found = described(toStream(soup, TestOrder::Keep));
  EXPECT_EQ(found.bodies, welded.cells());
  EXPECT_EQ(found.largest_body, 1);
  EXPECT_EQ(found.boundary_facets, 3 * welded.cells());
  EXPECT_EQ(found.boundary_parts, welded.cells());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_NE(found.notes[0].find("share no edge"), std::string::npos);
}

TEST(Describe, TellsHowManyDigitsAnOffsetLeaves)
{
  IndexedTestMesh mesh = sphere(2);
  const MeshDescription near = described(toStream(mesh));
  EXPECT_LT(near.resolution.offset, 1.0);
  EXPECT_GT(near.resolution.digits, 16.0);
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    mesh.positions[k] = static_cast<float>(mesh.positions[k] + 3464.0);
  }
  MemoryMesh far(toStream(mesh));
  EXPECT_NEAR(describe(far).resolution.offset, 1000.0, 1.0);
}

TEST(Describe, ReadsTheMeshOnceAndStops)
{
  const MemoryMesh mesh(toStream(torus(40, 20)), 50);
  describe(mesh);
  EXPECT_EQ(mesh.readings(), 1);
  DescribeOptions options;
  options.progress = [](double done) { return done < 0.5; };
  EXPECT_THROW(describe(mesh, options), Cancelled);
}

TEST(Describe, NamesTheMemoryThatIsTooLittle)
{
  DescribeOptions options;
  options.memoryLimit = 10000;
  const MemoryMesh mesh(toStream(torus(100, 50)));
  EXPECT_NE(messageOf([&] { describe(mesh, options); }).find("the description of the mesh needs"),
    std::string::npos);
}

/** Like the square root of the number of vertices of a surface, and of the power 2/3 of a solid,
 * also if it falls into thousands of bodies. */
TEST(DescribeLaw, MemoryFollowsTheWidth)
{
  const auto peakOf = [](const IndexedTestMesh& mesh)
  { return static_cast<double>(described(toStream(mesh), 200).pool_bytes_peak); };
  EXPECT_LT(peakOf(torus(400, 200)), 2.3 * peakOf(torus(200, 100)));
  EXPECT_LT(peakOf(tetBox(36, 36, 36)), 4.6 * peakOf(tetBox(18, 18, 18)));
  IndexedTestMesh grains = sphere(2);
  for (int doublings = 0; doublings < 6; ++doublings)
  {
    grains = disjointUnion(grains, grains, { 3, 0, 0 });
  }
  const double few = peakOf(grains);
  for (int doublings = 0; doublings < 4; ++doublings)
  {
    grains = disjointUnion(grains, grains, { 3, 0, 0 });
  }
  EXPECT_EQ(described(toStream(grains)).bodies, 1024);
  EXPECT_LE(peakOf(grains), 1.1 * few);
}

} // namespace smg::testing
