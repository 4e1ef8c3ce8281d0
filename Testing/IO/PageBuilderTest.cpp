// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/PageBuilder.h"

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Order/Pages/GroupPages.h"
#include "IO/Order/Pages/RankedVertices.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using NeighbourSets = std::map<std::uint32_t, std::set<std::uint32_t>>;

/** The content of pages, by the numbers of the raw mesh. */
struct Unpacked
{
  NeighbourSets neighbours;
  std::map<std::uint32_t, std::array<double, 3>> positions;
  std::vector<std::uint32_t> ids; ///< by rank
  std::int64_t crossing = 0, edges = 0;
};

class PageBuilder : public ::testing::Test
{
protected:
  static constexpr std::int64_t Memory = Workspace::MinMemory;

  RawMesh raw(const IndexedTestMesh& mesh, bool singlePrecision = false)
  {
    RawMeshBuilder builder(this->Space, CellChoice::Only);
    if (singlePrecision)
    {
      builder.useSinglePrecision();
    }
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    {
      builder.vertex(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    }
    const std::vector<std::int64_t>& corners = mesh.corners;
    const bool triangles = mesh.cellType == CellType::Triangle;
    for (std::size_t i = 0; i < corners.size(); i += triangles ? 3 : 4)
    {
      triangles ? builder.triangle(corners[i], corners[i + 1], corners[i + 2])
                : builder.tetrahedron(corners[i], corners[i + 1], corners[i + 2], corners[i + 3]);
    }
    return builder.finish();
  }

  Unpacked unpack(PagedMesh& mesh)
  {
    Unpacked result;
    VertexPages& pages = mesh.pages;
    std::vector<std::vector<std::uint32_t>> around;
    for (std::int64_t page = 0; page < pages.pages(); ++page)
    {
      Buffer bytes(this->Space.pool(), pages.bytes(page));
      pages.read(page, bytes.bytes());
      const PageView view = pages.view(page, bytes.data());
      EXPECT_EQ(pages.unplaced(page), pages.verticesOf(page));
      for (std::uint32_t i = 0; i < pages.verticesOf(page); ++i)
      {
        EXPECT_EQ(view.places()[i], NoIndex);
        this->addPosition(view.position(i, pages.positionBytes()), pages.doublePositions(),
          result.positions[view.ids()[i]]);
        result.ids.push_back(view.ids()[i]);
        view.neighbours(
          i, [&around = around.emplace_back()](std::uint32_t rank) { around.push_back(rank); });
      }
    }
    for (std::size_t rank = 0; rank < around.size(); ++rank)
    {
      for (const std::uint32_t other : around[rank])
      {
        const bool isNew = result.neighbours[result.ids[rank]].insert(result.ids.at(other)).second;
        EXPECT_TRUE(isNew) << "a neighbour twice";
        const auto size = static_cast<std::size_t>(pages.pageVertices());
        result.crossing += rank / size != other / size;
        ++result.edges;
      }
    }
    return result;
  }

  TemporaryFolder Folder;
  Workspace Space{ Folder.path(), Memory };

private:
  static void addPosition(const std::byte* bytes, bool isDouble, std::array<double, 3>& position)
  {
    std::array<float, 3> floats;
    if (isDouble)
    {
      std::memcpy(position.data(), bytes, sizeof position);
    }
    else
    {
      std::memcpy(floats.data(), bytes, sizeof floats);
      std::ranges::copy(floats, position.begin());
    }
  }
};

NeighbourSets neighbourSetsOf(const IndexedTestMesh& mesh)
{
  NeighbourSets result;
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    const std::size_t first = i / corners * corners;
    for (std::size_t k = first; k < first + corners; ++k)
    {
      if (mesh.corners[k] != mesh.corners[i])
      {
        result[std::uint32_t(mesh.corners[i])].insert(std::uint32_t(mesh.corners[k]));
      }
    }
  }
  return result;
}

/** Expects the pages to hold the used vertices of the mesh, and all edges. */
void expectPagesOf(const IndexedTestMesh& mesh, PagedMesh& paged, const Unpacked& pages)
{
  const std::set<std::int64_t> used(mesh.corners.begin(), mesh.corners.end());
  EXPECT_EQ(paged.pages.vertices(), std::int64_t(used.size()));
  EXPECT_EQ(paged.counts.isolatedVertices, mesh.vertices() - std::int64_t(used.size()));
  ASSERT_EQ(pages.ids.size(), used.size());
  EXPECT_EQ(std::set<std::int64_t>(pages.ids.begin(), pages.ids.end()), used);
  EXPECT_EQ(pages.neighbours, neighbourSetsOf(mesh));
  for (const auto& [id, position] : pages.positions)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double original = mesh.positions[std::size_t(id) * 3 + k];
      EXPECT_EQ(position[k], paged.pages.doublePositions() ? original : float(original));
    }
  }
  EXPECT_DOUBLE_EQ(paged.crossing, double(pages.crossing) / double(pages.edges));
}

/** The mesh with isolated vertices between its own. */
IndexedTestMesh withIsolatedVertices(const IndexedTestMesh& mesh)
{
  IndexedTestMesh result{ mesh.cellType, {}, mesh.corners };
  for (std::int64_t vertex = 0; vertex < mesh.vertices(); ++vertex)
  {
    const auto* position = mesh.positions.data() + vertex * 3;
    result.positions.insert(result.positions.end(), position, position + 3);
    result.positions.insert(result.positions.end(), { 1e9, 0, 0 });
  }
  for (std::int64_t& corner : result.corners)
  {
    corner *= 2;
  }
  return result;
}

/** A flat mesh in random order at other positions: `place` changes the coordinates of a vertex. */
template <class Place>
IndexedTestMesh placed(IndexedTestMesh mesh, Place&& place)
{
  mesh = shuffled(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
  {
    place(mesh.positions.data() + i);
  }
  return mesh;
}

TEST_F(PageBuilder, PagesHoldTheMesh)
{
  const IndexedTestMesh meshes[] = { shuffled(torus(60, 40, 0.1)), shuffled(tetBox(9, 10, 11)),
    withIsolatedVertices(shuffled(grid(37, 41))),
    shuffled(disjointUnion(sphere(2), torus(9, 9), { 5, 0, 0 })) };
  for (const IndexedTestMesh& mesh : meshes)
  {
    for (const bool topological : { false, true })
    {
      for (const int pageVertices : { 0, 100, 1 })
      {
        const bool singlePrecision = pageVertices == 100;
        const RawMesh raw = this->raw(mesh, singlePrecision);
        PagedMesh paged = buildPages(raw, this->Space, { pageVertices, topological });
        EXPECT_EQ(paged.pages.doublePositions(), !singlePrecision);
        expectPagesOf(mesh, paged, this->unpack(paged));
        if (pageVertices > 0)
        {
          EXPECT_EQ(paged.pages.pageVertices(), pageVertices);
        }
      }
    }
  }
}

TEST_F(PageBuilder, GroupsOfCellsFitTogether)
{
  // So large that the cells are collected in several groups.
  const IndexedTestMesh mesh = shuffled(grid(300, 300));
  const RawMesh raw = this->raw(mesh);
  PagedMesh paged = buildPages(raw, this->Space);
  const Unpacked pages = this->unpack(paged);
  expectPagesOf(mesh, paged, pages);
  EXPECT_EQ(paged.counts.boundaryEdges, 4 * 299);
  EXPECT_EQ(paged.counts.nonManifoldEdges, 0);
  EXPECT_EQ(paged.counts.nonManifoldVertices, 0);

  EXPECT_EQ(paged.sampleStride, 5);
  ASSERT_EQ(paged.samples.size(), pages.ids.size() / 5 * 3);
  for (std::size_t i = 0; i < paged.samples.size(); ++i)
  {
    const std::uint32_t id = pages.ids[i / 3 * 5];
    EXPECT_EQ(paged.samples[i], float(mesh.positions[id * 3 + i % 3]));
  }
}

TEST_F(PageBuilder, CountsEdges)
{
  struct Case
  {
    IndexedTestMesh mesh;
    std::int64_t boundary, nonManifold, vertices;
  };
  IndexedTestMesh bowTie = disjointUnion(grid(5, 5), grid(5, 5));
  std::ranges::replace(bowTie.corners, 25, 0);
  IndexedTestMesh tripled = sphere(1);
  for (int copy = 0; copy < 2; ++copy)
  {
    tripled.corners.insert(
      tripled.corners.end(), tripled.corners.begin(), tripled.corners.begin() + 3);
  }
  IndexedTestMesh repeated = sphere(1);
  repeated.corners.insert(repeated.corners.end(), { 0, 0, 1, 2, 2, 2 });
  const Case cases[] = { { sphere(3), 0, 0, 0 }, { grid(20, 30), 2 * (19 + 29), 0, 0 },
    { bowTie, 32, 0, 1 }, { tripled, 0, 3, 0 }, { repeated, 0, 0, 0 } };
  for (const Case& one : cases)
  {
    const RawMesh raw = this->raw(one.mesh);
    const MeshCounts counts = buildPages(raw, this->Space, { 16 }).counts;
    EXPECT_EQ(counts.boundaryEdges, one.boundary);
    EXPECT_EQ(counts.nonManifoldEdges, one.nonManifold);
    EXPECT_EQ(counts.nonManifoldVertices, one.vertices);
  }
  const MeshCounts counts = buildPages(this->raw(tetBox(3, 3, 3)), this->Space).counts;
  EXPECT_EQ(counts.boundaryEdges, -1);
  EXPECT_EQ(counts.nonManifoldEdges, -1);
  EXPECT_EQ(counts.nonManifoldVertices, -1);
}

TEST_F(PageBuilder, FewEdgesLeaveTheirPageWhateverTheShape)
{
  // Of a square of 512 vertices, about 4 * 22.6 * 2 of 6 * 512 directed edges cross the border:
  // 0.06.
  const IndexedTestMesh flat = grid(250, 250);
  Random random(1);
  const auto crossing = [this](const IndexedTestMesh& mesh)
  { return buildPages(this->raw(mesh), this->Space, { 512 }).crossing; };
  EXPECT_LT(crossing(placed(flat, [](double*) {})), 0.1);
  EXPECT_LT(crossing(placed(flat, [](double* p) { p[0] *= 1e4; })), 0.1) << "stretched";
  EXPECT_LT(crossing(placed(flat, [](double* p) { p[0] += 1e3 * p[1]; })), 0.1) << "sheared";
  EXPECT_LT(
    crossing(placed(flat, [&random](double* p) { p[0] = random.below(1000) == 0 ? 1e12 : p[0]; })),
    0.12)
    << "outliers";
  EXPECT_LT(crossing(placed(
              flat, [&random](double* p) { p[1] = random.below(1000) == 0 ? -1.7e308 : p[1]; })),
    0.12)
    << "huge outliers";
  EXPECT_LT(crossing(placed(tetBox(40, 40, 40), [](double* p) { p[2] *= 1e-3; })), 0.35)
    << "a squeezed box";
}

TEST_F(PageBuilder, CoordinatesThatSayNothingGiveWayToTheGraph)
{
  Random random(1);
  const IndexedTestMesh flat = grid(250, 250);
  const auto anywhere = [&random](double* p)
  { std::generate_n(p, 3, [&] { return random.uniform(); }); };
  const auto crossing = [this](const IndexedTestMesh& mesh, int pageVertices)
  { return buildPages(this->raw(mesh), this->Space, { pageVertices }).crossing; };
  EXPECT_LT(crossing(placed(flat, anywhere), 512), 0.2);
  EXPECT_LT(crossing(placed(flat, [](double* p) { std::fill_n(p, 3, 7.0); }), 512), 0.2);
  EXPECT_LT(crossing(placed(tetBox(30, 30, 30), anywhere), 256), 0.5);
}

TEST_F(PageBuilder, NumbersInSequenceAreUsedWhereTheyAreBetter)
{
  // A strip whose vertices are numbered along it and have random positions.
  IndexedTestMesh strip = grid(2, 20000);
  Random random(1);
  std::ranges::generate(strip.positions, [&random] { return random.uniform(); });
  PagedMesh paged = buildPages(this->raw(strip), this->Space, { 512 });
  EXPECT_LT(paged.crossing, 0.01);
  const Unpacked pages = this->unpack(paged);
  EXPECT_TRUE(std::ranges::is_sorted(pages.ids));
}

TEST_F(PageBuilder, SplitsGroupsThatDoNotFit)
{
  const IndexedTestMesh mesh = shuffled(tetBox(24, 24, 24));
  const RawMesh raw = this->raw(mesh);
  // Ranks are the numbers: every group has cells with most others.
  RecordFile<RankedVertex<double>> vertices(this->Space);
  for (std::uint32_t i = 0; i < mesh.vertices(); ++i)
  {
    const auto* p = mesh.positions.data() + i * 3;
    vertices.put({ { p[0], p[1], p[2] }, i });
  }
  vertices.close();
  CellGroups groups(this->Space, { 0, mesh.vertices() }, mesh.vertices(), 4, 1 << 20);
  for (std::size_t i = 0; i < mesh.corners.size(); i += 4)
  {
    std::array<std::uint32_t, 4> cell;
    std::copy_n(mesh.corners.begin() + std::ptrdiff_t(i), 4, cell.begin());
    groups.put(cell);
  }
  groups.close();
  // The links take 3.5 MB.
  const std::int64_t left = std::int64_t(5) << 19;
  const Buffer ballast(
    this->Space.pool(), static_cast<std::size_t>(this->Space.available() - left));
  GroupPages<double> pages(raw, this->Space, vertices, 200);
  pages.append(groups, 0);
  PagedMesh paged = pages.finish();
  expectPagesOf(mesh, paged, this->unpack(paged));
}

TEST_F(PageBuilder, NamesTheMemoryThatManyCellsAtAVertexNeed)
{
  constexpr std::int64_t spokes = 600000;
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  for (std::int64_t i = 0; i < spokes + 1; ++i)
  {
    builder.vertex(double(i), 0, 0);
  }
  for (std::int64_t i = 1; i < spokes; ++i)
  {
    builder.triangle(0, i, i + 1);
  }
  const RawMesh mesh = builder.finish();
  try
  {
    buildPages(mesh, this->Space);
    FAIL() << "such a page fits into 16 MiB";
  }
  catch (const Error& error)
  {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "raise the memory limit", error.what());
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "a vertex has 599999 cells", error.what());
    // The stated memory is sufficient.
    const std::string text = error.what();
    const std::int64_t needed = std::stoll(text.substr(text.find("needs ") + 6)) << 20;
    EXPECT_GT(needed, Memory);
    Workspace larger(this->Folder.path(), needed);
    EXPECT_EQ(buildPages(mesh, larger).pages.vertices(), spokes + 1);
  }
}

TEST_F(PageBuilder, UsedVerticesAreFoundInPieces)
{
  const IndexedTestMesh mesh = withIsolatedVertices(shuffled(grid(30, 30)));
  const RawMesh raw = this->raw(mesh);
  for (const std::int64_t bytes : { 8, 40, 100000 })
  {
    UsedVertices used(raw, this->Space, bytes);
    for (std::uint32_t vertex = 0; vertex < mesh.vertices(); ++vertex)
    {
      EXPECT_EQ(used.contains(vertex), vertex % 2 == 0);
    }
  }
}

} // namespace
} // namespace smg::testing
