// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/MeshText.h"
#include "Testing/Python/C/CInterface.h"
#include "Testing/Support/FileMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

// Meshes and columns of arrays: any types and strides, in their own order.

namespace smg::testing
{
namespace
{

std::vector<double> positionsOf(smg_mesh* mesh)
{
  return read<double>(mesh, nullptr, "Position", false, 3, Counts(mesh).vertices);
}

std::vector<std::int64_t> cornersOfMesh(smg_mesh* mesh, int corners)
{
  return read<std::int64_t>(mesh, nullptr, "Corners", true, corners, Counts(mesh).cells);
}

/** A mesh with a vertex of no cell in the middle of its vertices, and one at their end. */
IndexedTestMesh withUnusedPoints()
{
  IndexedTestMesh mesh = shuffled(torus(12, 9, 0.1));
  const std::int64_t unused = 5;
  mesh.positions.insert(mesh.positions.begin() + 3 * unused, { 10.0, 11.0, 12.0 });
  mesh.positions.insert(mesh.positions.end(), { -10.0, -11.0, -12.0 });
  for (std::int64_t& corner : mesh.corners)
  {
    corner += corner >= unused ? 1 : 0;
  }
  return mesh;
}

TEST(CArrays, AMeshIsReadInTheOrderOfItsArrays)
{
  for (const IndexedTestMesh& mesh :
    { withUnusedPoints(), shuffled(tetBox(6, 5, 4, 0.1)), sphere(1) })
  {
    const MeshHandle handle = openMesh(mesh);
    ASSERT_TRUE(handle);
    const Counts counts(handle.get());
    EXPECT_EQ(counts.vertices, mesh.vertices());
    EXPECT_EQ(counts.cells, mesh.cells());
    EXPECT_EQ(positionsOf(handle.get()), mesh.positions);
    EXPECT_EQ(cornersOfMesh(handle.get(), cornersOf(mesh.cellType)), mesh.corners);
  }
}

/** A problem with values everywhere on the mesh, so that each vertex matters. */
std::vector<double> solutionOn(smg_mesh* mesh)
{
  const FieldHandle field = run(mesh, "solve",
    R"({"problem": {"source": 1, "dirichlet": [{"vertices": [0, 1, 2], "value": 0}]}})");
  return read<double>(nullptr, field.get(), "Solution", false, 1, Counts(mesh).vertices);
}

TEST(CArrays, AMeshOfArraysIsThatOfAFileWithTheSameOrder)
{
  const TemporaryFolder folder;
  const IndexedTestMesh mesh = withUnusedPoints();
  writeBytes(folder / "mesh.off", meshText(mesh));
  const MeshHandle file = openFile(folder / "mesh.off"), arrays = openMesh(mesh);
  EXPECT_EQ(positionsOf(file.get()), mesh.positions);
  EXPECT_EQ(cornersOfMesh(file.get(), 3), mesh.corners);
  const std::vector<double> ofFile = solutionOn(file.get()), ofArrays = solutionOn(arrays.get());
  ASSERT_EQ(ofFile.size(), ofArrays.size());
  for (std::size_t v = 0; v < ofFile.size(); ++v)
  {
    const bool isUnused = v == 5 || v + 1 == ofFile.size();
    EXPECT_EQ(std::isnan(ofArrays[v]), isUnused) << v;
    EXPECT_TRUE(isUnused || ofArrays[v] == ofFile[v]) << v;
  }
}

/** The rows of a mesh's arrays in types and strides of the caller's. */
template <class Point, class Corner>
MeshHandle openStrided(const IndexedTestMesh& mesh)
{
  // Every second row of a table, from the last one, whose columns are far apart.
  const std::int64_t vertices = mesh.vertices(), cells = mesh.cells();
  std::vector<Point> points(static_cast<std::size_t>(6 * vertices));
  for (std::int64_t v = 0; v < vertices; ++v)
  {
    for (std::int64_t k = 0; k < 3; ++k)
    {
      points[static_cast<std::size_t>(k * 2 * vertices + 2 * (vertices - 1 - v))] =
        static_cast<Point>(mesh.positions[static_cast<std::size_t>(3 * v + k)]);
    }
  }
  const std::vector<Corner> corners(mesh.corners.begin(), mesh.corners.end());
  constexpr auto PointBytes = static_cast<std::int64_t>(sizeof(Point));
  const smg_array ofPoints = { &points[static_cast<std::size_t>(2 * (vertices - 1))],
    static_cast<smg_type>(scalarTypeOf<Point>()), vertices, 3, -2 * PointBytes,
    2 * vertices * PointBytes };
  const smg_array ofCells = arrayOf(corners, cornersOf(mesh.cellType));
  EXPECT_EQ(ofCells.rows, cells);
  smg_mesh* handle = nullptr;
  expectOk(smg_open_arrays(&ofPoints, &ofCells, nullptr, nullptr, nullptr, &handle));
  return MeshHandle(handle);
}

TEST(CArrays, PointsAndCornersMayHaveAnyTypeAndStride)
{
  // Whole numbers that all types hold.
  const IndexedTestMesh mesh = shuffled(tetBox(5, 4, 3));
  const auto expectMesh = [&mesh](const MeshHandle& handle)
  {
    ASSERT_TRUE(handle);
    EXPECT_EQ(positionsOf(handle.get()), mesh.positions);
    EXPECT_EQ(cornersOfMesh(handle.get(), 4), mesh.corners);
  };
  expectMesh(openStrided<double, std::int64_t>(mesh));
  expectMesh(openStrided<float, std::int32_t>(mesh));
  expectMesh(openStrided<std::int8_t, std::uint8_t>(mesh));
  expectMesh(openStrided<std::uint8_t, std::int8_t>(mesh));
  expectMesh(openStrided<std::int16_t, std::uint16_t>(mesh));
  expectMesh(openStrided<std::uint16_t, std::int16_t>(mesh));
  expectMesh(openStrided<std::int32_t, std::uint32_t>(mesh));
  expectMesh(openStrided<std::uint32_t, std::uint64_t>(mesh));
  expectMesh(openStrided<std::int64_t, std::uint64_t>(mesh));
}

TEST(CArrays, AddedColumnsAreThoseOfTheFileInEveryWay)
{
  const TemporaryFolder folder;
  const IndexedTestMesh mesh = withUnusedPoints();
  std::vector<float> colour(static_cast<std::size_t>(3 * mesh.vertices()));
  std::vector<std::int16_t> part(static_cast<std::size_t>(mesh.cells()));
  std::iota(colour.begin(), colour.end(), 0.5F);
  std::iota(part.begin(), part.end(), std::int16_t(-7));
  const MeshHandle handle = openMesh(mesh);
  const smg_array colours = arrayOf(colour, 3), parts = arrayOf(part);
  expectOk(smg_add_column(handle.get(), "colour", 0, &colours, nullptr, nullptr));
  expectOk(smg_add_column(handle.get(), "part", 1, &parts, nullptr, nullptr));
  EXPECT_EQ(columnNames(handle.get(), nullptr, "vertices"),
    (std::vector<std::string>{ "OriginalId", "colour" }));
  EXPECT_EQ(read<float>(handle.get(), nullptr, "colour", false, 3, mesh.vertices()), colour);
  EXPECT_EQ(read<std::int16_t>(handle.get(), nullptr, "part", true, 1, mesh.cells()), part);

  // In a file that knows the order of its original, and in one in that order.
  for (const char* name : { "mesh.vsm", "mesh.vtu" })
  {
    const std::filesystem::path path = folder / name;
    expectOk(smg_save_mesh(handle.get(), path.c_str(), nullptr, nullptr, nullptr, nullptr));
    const MeshHandle again = openFile(path);
    ASSERT_TRUE(again) << name;
    EXPECT_EQ(positionsOf(again.get()), mesh.positions) << name;
    EXPECT_EQ(cornersOfMesh(again.get(), 3), mesh.corners) << name;
    EXPECT_EQ(read<float>(again.get(), nullptr, "colour", false, 3, mesh.vertices()), colour)
      << name;
    EXPECT_EQ(read<std::int16_t>(again.get(), nullptr, "part", true, 1, mesh.cells()), part)
      << name;
  }
}

TEST(CArrays, AColumnIsReplacedAndTakenAway)
{
  const IndexedTestMesh mesh = sphere(1);
  const MeshHandle handle = openMesh(mesh);
  const std::vector<double> first(static_cast<std::size_t>(mesh.vertices()), 1.0);
  const std::vector<std::uint8_t> second(static_cast<std::size_t>(mesh.vertices()), 2);
  const smg_array ofFirst = arrayOf(first), ofSecond = arrayOf(second);
  expectOk(smg_add_column(handle.get(), "a", 0, &ofFirst, nullptr, nullptr));
  expectOk(smg_add_column(handle.get(), "a", 0, &ofSecond, nullptr, nullptr));
  EXPECT_EQ(read<std::uint8_t>(handle.get(), nullptr, "a", false, 1, mesh.vertices()), second);
  expectOk(smg_remove_column(handle.get(), "a", 0));
  EXPECT_EQ(
    columnNames(handle.get(), nullptr, "vertices"), (std::vector<std::string>{ "OriginalId" }));
  expectOk(smg_remove_column(handle.get(), "a", 0));
}

TEST(CArrays, ArgumentsAreOfJobsAlone)
{
  const TemporaryFolder folder;
  const IndexedTestMesh mesh = shuffled(sphere(2));
  const MeshHandle handle = openMesh(mesh);
  std::vector<double> value(static_cast<std::size_t>(mesh.vertices()));
  std::iota(value.begin(), value.end(), 0.0);
  const smg_array values = arrayOf(value);
  const std::vector<float> kept(value.size(), 3.0F);
  const smg_array keeps = arrayOf(kept);
  expectOk(smg_add_column(handle.get(), "#1", 0, &keeps, nullptr, nullptr));
  EXPECT_EQ(smg_add_argument(handle.get(), "#1", 0, &values, nullptr, nullptr), SMG_INVALID);
  EXPECT_NE(std::string(smg_error()).find("has a column of this name"), std::string::npos);
  expectOk(smg_add_argument(handle.get(), "#0", 0, &keeps, nullptr, nullptr));
  expectOk(smg_add_argument(handle.get(), "#0", 0, &values, nullptr, nullptr));
  const FieldHandle field = run(handle.get(), "solve",
    R"({"problem": {"dirichlet": [{"halfspace": [0, 0, 1, 0], "value": "#0"}]}})");
  const std::vector<double> u =
    read<double>(nullptr, field.get(), "Solution", false, 1, mesh.vertices());
  for (std::size_t v = 0; v < value.size(); ++v)
  {
    if (mesh.positions[3 * v + 2] > 0.0)
    {
      EXPECT_EQ(u[v], value[v]);
    }
  }
  EXPECT_EQ(columnNames(nullptr, field.get(), "vertices"),
    (std::vector<std::string>{ "OriginalId", "#1", "Solution" }));
  const std::vector<std::string> own{ "OriginalId", "#1" };
  EXPECT_EQ(columnNames(handle.get(), nullptr, "vertices"), own);
  const char* text = nullptr;
  expectOk(smg_info(handle.get(), 1, nullptr, nullptr, &text));
  const nlohmann::json info = nlohmann::json::parse(text);
  EXPECT_EQ(info.at("columns").at("vertices").size(), 2u);
  EXPECT_EQ(info.at("description").at("columns").at("vertices").size(), 2u);
  EXPECT_EQ(smg_read(handle.get(), nullptr, "#0", 0, nullptr, nullptr, value.data()), SMG_INVALID);
  const std::filesystem::path small = folder / "small.vsm";
  expectOk(
    smg_simplify(handle.get(), R"({"vertices": 50})", small.c_str(), nullptr, nullptr, nullptr));
  EXPECT_EQ(columnNames(openFile(small).get(), nullptr, "vertices"), own);
  const std::filesystem::path path = folder / "u.vtu";
  expectOk(smg_save(field.get(), path.c_str(), nullptr, nullptr, nullptr, nullptr));
  const FileMesh file = readFileMesh(path);
  EXPECT_EQ(file.pointData.size(), 2u);
  EXPECT_EQ(file.pointData.at("Solution"), u);
}

TEST(CArrays, TheCellsOfAPolygonFollowEachOther)
{
  const TemporaryFolder folder;
  // A strip of squares and triangles in turn; the strip's order is the reverse of the file's.
  writeBytes(folder / "mesh.off", "OFF\n7 3 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n0 1 0\n1 1 0\n2 1 0\n"
                                  "4 1 2 6 5\n3 2 3 6\n4 0 1 5 4\n");
  const MeshHandle handle = openFile(folder / "mesh.off");
  std::vector<std::array<std::int64_t, 3>> cells(5);
  const std::vector<std::int64_t> corners = cornersOfMesh(handle.get(), 3);
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    std::copy_n(&corners[3 * c], 3, cells[c].begin());
  }
  std::sort(cells.begin(), cells.begin() + 2);
  std::sort(cells.begin() + 3, cells.end());
  EXPECT_EQ(cells, (std::vector<std::array<std::int64_t, 3>>{
                     { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 6 }, { 0, 1, 5 }, { 0, 5, 4 } }));
  const std::vector<std::int32_t> part{ 0, 1, 2, 3, 4 };
  const smg_array parts = arrayOf(part);
  expectOk(smg_add_column(handle.get(), "part", 1, &parts, nullptr, nullptr));
  EXPECT_EQ(read<std::int32_t>(handle.get(), nullptr, "part", true, 1, 5), part);
}

} // namespace
} // namespace smg::testing
