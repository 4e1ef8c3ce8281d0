// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/Polygons.h"
#include "IO/Formats/MeshFile.h"
#include "IO/Formats/WriteFiles.h"
#include "IO/Import/RawMeshBuilder.h"

#include "Solver/Core/Vector.h"
#include "Testing/IO/MeshText.h"
#include "Testing/IO/RandomPolygons.h"
#include "Testing/Support/FileMesh.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** Polygons beside each other, and triangles between them. */
struct PolygonMesh
{
  std::vector<double> points;
  std::vector<std::vector<std::int64_t>> cells;
  std::vector<double> areas; ///< of the cells

  explicit PolygonMesh(int count)
  {
    Random random(5);
    for (int k = 0; k < count; ++k)
    {
      this->add(randomPolygon(random, k));
      this->add({ { 0, 0, 0, 2, 0, 0, 0, 1, 0 }, 1.0 });
    }
  }

  std::string text(const std::string& suffix) const
  {
    const auto vertices = std::to_string(this->points.size() / 3);
    const auto faces = std::to_string(this->cells.size());
    const bool isObj = suffix == ".obj";
    std::size_t numbers = 0;
    std::string points, faceLines;
    for (std::size_t k = 0; k < this->points.size(); k += 3)
    {
      points += (isObj ? "v " : "") + exact(this->points[k]) + ' ' + exact(this->points[k + 1]) +
                ' ' + exact(this->points[k + 2]) + '\n';
    }
    for (const std::vector<std::int64_t>& cell : this->cells)
    {
      faceLines += isObj ? "f" : std::to_string(cell.size());
      for (const std::int64_t corner : cell)
      {
        faceLines += ' ' + std::to_string(corner + (isObj ? 1 : 0));
      }
      faceLines += '\n';
      numbers += cell.size() + 1;
    }
    const std::string header =
      isObj              ? ""
      : suffix == ".off" ? "OFF\n" + vertices + ' ' + faces + " 0\n"
      : suffix == ".ply"
        ? "ply\nformat ascii 1.0\nelement vertex " + vertices +
            "\nproperty double x\nproperty double y\nproperty double z\nelement face " + faces +
            "\nproperty list int int vertex_indices\nend_header\n"
        : "# vtk DataFile Version 3.0\npolygons\nASCII\nDATASET POLYDATA\nPOINTS " + vertices +
            " double\n";
    const std::string between =
      suffix == ".vtk" ? "POLYGONS " + faces + ' ' + std::to_string(numbers) + '\n' : "";
    return header + points + between + faceLines;
  }

private:
  void add(const RandomPolygon& polygon)
  {
    std::vector<std::int64_t>& cell = this->cells.emplace_back();
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      cell.push_back(static_cast<std::int64_t>(this->points.size() / 3 + k));
    }
    this->points.insert(this->points.end(), polygon.corners.begin(), polygon.corners.end());
    this->areas.push_back(polygon.area);
  }
};

} // namespace

namespace
{

/** The area of each element. */
std::vector<double> areasOf(const ReadMesh& mesh)
{
  std::vector<double> areas(static_cast<std::size_t>(mesh.elementCount));
  for (std::size_t cell = 0; cell < mesh.elements.size(); ++cell)
  {
    const auto position = [&](std::size_t k)
    { return &mesh.positions[3 * std::size_t(mesh.corners[3 * cell + k])]; };
    const Vector area =
      cross(difference(position(1), position(0)), difference(position(2), position(0)));
    areas[std::size_t(mesh.elements[cell])] += std::sqrt(dot(area, area)) / 2;
  }
  return areas;
}

} // namespace

TEST(Polygons, HaveTheirAreaInEveryFormatAndComeBackTheSame)
{
  const TemporaryFolder folder;
  const PolygonMesh mesh(300);
  const double all = std::accumulate(mesh.areas.begin(), mesh.areas.end(), 0.0);
  Workspace workspace(folder.path(), Workspace::MinMemory);
  for (const char* suffix : { ".obj", ".off", ".ply", ".vtk" })
  {
    SCOPED_TRACE(suffix);
    const std::filesystem::path in = folder / ("in" + std::string(suffix));
    writeBytes(in, mesh.text(suffix));
    RawMesh raw = importMesh(in, workspace);
    cutPolygons(raw, workspace);
    EXPECT_TRUE(raw.counts.notes.empty());
    const std::vector<double> areas = areasOf(readRaw(raw));
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      EXPECT_NEAR(areas[cell], mesh.areas[cell], 1e-9 * (1 + mesh.areas[cell])) << cell;
    }

    convert(in, folder / "mesh.vsm");
    writeRestored(folder / "mesh.vsm", folder / ("out" + std::string(suffix)), workspace);
    EXPECT_EQ(readFileMesh(folder / ("out" + std::string(suffix))).cells, mesh.cells);
  }
  // Formats without polygons have their triangles; those with quadrilaterals have these.
  for (const char* suffix : { ".stl", ".mesh", ".msh", ".node" })
  {
    SCOPED_TRACE(suffix);
    const std::filesystem::path out = folder / ("out" + std::string(suffix));
    writeRestored(folder / "mesh.vsm", out, workspace);
    RawMesh raw = importMesh(out, workspace);
    cutPolygons(raw, workspace);
    const std::vector<double> areas = areasOf(readRaw(raw));
    // STL is in single precision.
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), all, 1e-4 * all);
  }
}

TEST(Polygons, ThatCannotBeCutAreNoted)
{
  const TemporaryFolder folder;
  Workspace workspace(folder.path(), Workspace::MinMemory);
  RawMeshBuilder builder(workspace, CellChoice::Only);
  constexpr std::int64_t Many = 400'000;
  std::vector<std::int64_t> corners;
  for (std::int64_t k = 0; k < Many; ++k)
  {
    builder.vertex(std::cos(6.0 * double(k) / Many), std::sin(6.0 * double(k) / Many), k % 2);
    corners.push_back(k);
  }
  builder.polygon(corners);
  builder.polygon(std::array<std::int64_t, 4>{ 0, 200'000, 100'000, 300'000 });
  // A strip is none.
  builder.strip(std::array<std::int64_t, 4>{ 0, 200'000, 100'000, 300'000 });
  RawMesh mesh = builder.finish();
  const ReadMesh before = readRaw(mesh);
  cutPolygons(mesh, workspace);
  EXPECT_LE(workspace.pool().peak(), Workspace::MinMemory);
  // Only the quadrilateral is cut anew.
  const auto outside = [](const ReadMesh& read)
  {
    std::vector<std::int64_t> corners = read.corners;
    corners.erase(corners.end() - 12, corners.end() - 6);
    return corners;
  };
  EXPECT_EQ(outside(readRaw(mesh)), outside(before));
  ASSERT_EQ(mesh.counts.notes.size(), 2U);
  EXPECT_NE(mesh.counts.notes[0].find("1 polygon crosses itself"), std::string::npos);
  EXPECT_NE(mesh.counts.notes[1].find("1 polygon has more than"), std::string::npos);
}

} // namespace smg::testing
