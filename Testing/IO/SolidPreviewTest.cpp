// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/SolidPreview.h"

#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/TestMeshes.h"
#include "smg/Error.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

namespace smg::testing
{
namespace
{

/** The volumes of the tetrahedra; negative if they are turned over. */
std::vector<double> volumesOf(
  const std::vector<double>& positions, const std::vector<std::int64_t>& corners)
{
  std::vector<double> volumes;
  for (std::size_t c = 0; c < corners.size(); c += 4)
  {
    const auto point = [&](std::size_t k)
    { return Eigen::Vector3d(positions.data() + 3 * corners[c + k]); };
    Eigen::Matrix3d edges;
    edges << point(1) - point(0), point(2) - point(0), point(3) - point(0);
    volumes.push_back(edges.determinant() / 6.0);
  }
  return volumes;
}

double sum(const std::vector<double>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

/** Expects a proper tetrahedral mesh of at most so many points, all of them vertices of the mesh.
 */
void expectProper(const MeshPiece& preview, const StreamMesh& mesh, std::int64_t maximumPoints)
{
  EXPECT_LE(std::int64_t(preview.ids.size()), maximumPoints);
  EXPECT_TRUE(std::ranges::is_sorted(preview.ids));
  for (std::size_t i = 0; i < preview.ids.size(); ++i)
  {
    for (std::int64_t k = 0; k < 3; ++k)
    {
      ASSERT_EQ(preview.positions[3 * i + k], mesh.positions[3 * preview.ids[i] + k]);
    }
  }
  const std::vector<double> volumes = volumesOf(preview.positions, preview.corners);
  ASSERT_FALSE(volumes.empty());
  // None is turned over, and none is flat compared to the others.
  EXPECT_GT(std::ranges::min(volumes), 0.02 * std::ranges::max(volumes));
  std::set<std::int64_t> used;
  std::set<std::array<std::int64_t, 4>> known;
  for (std::size_t c = 0; c < preview.corners.size(); c += 4)
  {
    std::array<std::int64_t, 4> corners;
    std::copy_n(preview.corners.begin() + static_cast<std::ptrdiff_t>(c), 4, corners.begin());
    used.insert(corners.begin(), corners.end());
    std::ranges::sort(corners);
    EXPECT_TRUE(known.insert(corners).second);
  }
  EXPECT_EQ(used.size(), preview.ids.size());
}

} // namespace

TEST(SolidPreview, FillsTheSolid)
{
  const StreamMesh mesh = toStream(shuffled(tetBox(36, 30, 24, 0.2)));
  const MeshPiece preview = makeSolidPreview(MemoryMesh(mesh), 10000);
  // One point for 20 vertices.
  const std::int64_t most = mesh.vertices() / 20;
  expectProper(preview, mesh, most);
  EXPECT_GT(std::int64_t(preview.ids.size()), most / 2);
  // The outermost layer, half a cell thick, is lost where lattice points lie outside.
  const double filled = sum(volumesOf(preview.positions, preview.corners)) / (35.0 * 29.0 * 23.0);
  EXPECT_GT(filled, 0.85);
  EXPECT_LT(filled, 1.0);
}

TEST(SolidPreview, IsBoundedByTheLimit)
{
  const StreamMesh mesh = toStream(tetBox(20, 20, 40, 0.2));
  for (const std::int64_t limit : { 40, 150, 400 })
  {
    const MeshPiece preview = makeSolidPreview(MemoryMesh(mesh), limit);
    expectProper(preview, mesh, limit);
    EXPECT_GT(std::int64_t(preview.ids.size()), limit / 2);
  }
}

TEST(SolidPreview, DoesNotDependOnBlocks)
{
  const StreamMesh mesh = toStream(tetBox(14, 13, 12, 0.2));
  const MeshPiece one = makeSolidPreview(MemoryMesh(mesh, 100000), 100);
  const MeshPiece many = makeSolidPreview(MemoryMesh(mesh, 7), 100);
  EXPECT_EQ(one.ids, many.ids);
  EXPECT_EQ(one.corners, many.corners);
}

TEST(SolidPreview, ASmallMeshStaysAsItIs)
{
  const StreamMesh mesh = toStream(shuffled(tetBox(5, 4, 3, 0.1)));
  const MeshPiece preview = makeSolidPreview(MemoryMesh(mesh), 200);
  EXPECT_EQ(preview.positions, mesh.positions);
  EXPECT_EQ(std::int64_t(preview.corners.size() / 4), mesh.cells());
  const std::vector<double> volumes = volumesOf(preview.positions, preview.corners);
  EXPECT_GT(std::ranges::min(volumes), 0.0);
  std::vector<double> all = volumesOf(mesh.positions, mesh.corners);
  std::ranges::for_each(all, [](double& volume) { volume = std::fabs(volume); });
  EXPECT_NEAR(sum(volumes), sum(all), 1e-9);
}

TEST(SolidPreview, HasNoTetrahedraOfAFlatMesh)
{
  StreamMesh mesh = toStream(tetBox(12, 12, 12));
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3)
  {
    mesh.positions[i] = 0.0;
  }
  EXPECT_TRUE(makeSolidPreview(MemoryMesh(mesh), 50).corners.empty());
  mesh.positions.assign(mesh.positions.size(), 1.0);
  EXPECT_TRUE(makeSolidPreview(MemoryMesh(mesh), 50).corners.empty());
}

TEST(SolidPreview, KeepsTwoSolidsApart)
{
  const IndexedTestMesh one = tetBox(16, 16, 16, 0.2);
  const StreamMesh mesh = toStream(disjointUnion(one, one, { 30, 0, 0 }));
  const MeshPiece preview = makeSolidPreview(MemoryMesh(mesh), 400);
  expectProper(preview, mesh, 400);
  for (std::size_t c = 0; c < preview.corners.size(); c += 4)
  {
    const auto isRight = [&](std::size_t k)
    { return preview.positions[3 * preview.corners[c + k]] > 20.0; };
    EXPECT_TRUE(isRight(0) == isRight(1) && isRight(1) == isRight(2) && isRight(2) == isRight(3));
  }
  const double half = sum(volumesOf(preview.positions, preview.corners)) / (2.0 * 15 * 15 * 15);
  EXPECT_GT(half, 0.75);
}

TEST(SolidPreview, ReportsProgressAndIsCancelled)
{
  const MemoryMesh mesh(toStream(tetBox(14, 13, 12)), 100);
  double last = 0.0;
  makeSolidPreview(mesh, 50,
    [&last](double done)
    {
      EXPECT_GE(done, last);
      last = done;
      return true;
    });
  EXPECT_EQ(last, 1.0);
  for (const double end : { 0.1, 0.7 })
  {
    EXPECT_THROW(makeSolidPreview(mesh, 50, [end](double done) { return done < end; }), Cancelled);
  }
}

} // namespace smg::testing
