// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/VertexNormals.h"

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace smg::testing
{
namespace
{

/** The normals of a mesh, and their scratch folder. */
class VertexNormalsTest : public ::testing::Test
{
protected:
  std::vector<float> normals(
    const StreamMesh& mesh, std::int64_t blockCells = 100, std::int64_t memory = 1 << 24)
  {
    MemorySource source(mesh, blockCells);
    NormalsOptions options;
    options.scratch = this->Folder.path();
    options.memory = memory;
    const VertexNormals normals(source, options);
    EXPECT_EQ(normals.vertices(), mesh.vertices());
    EXPECT_EQ(this->Folder.entries(), 0);
    std::vector<float> values(mesh.positions.size());
    normals.read(0, mesh.vertices(), values);
    // Arbitrary ranges.
    std::vector<float> some(9);
    normals.read(mesh.vertices() - 3, 3, some);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), values.end() - 9));
    return values;
  }

  TemporaryFolder Folder;
};

TEST_F(VertexNormalsTest, OfASphereAreRadial)
{
  const StreamMesh mesh = toStream(sphere(4));
  const std::vector<float> normals = this->normals(mesh);
  double worst = 0.0;
  for (std::size_t i = 0; i < normals.size(); i++)
  {
    worst = std::max(worst, std::abs(normals[i] - mesh.positions[i]));
  }
  EXPECT_LT(worst, 3e-3);
}

TEST_F(VertexNormalsTest, DoNotDependOnBlocksNorMemory)
{
  const StreamMesh mesh = toStream(torus(80, 60, 0.3));
  const std::vector<float> expected = this->normals(mesh, 1000000);
  for (const std::int64_t blockCells : { 1, 7, 1000 })
  {
    EXPECT_EQ(this->normals(mesh, blockCells), expected);
    EXPECT_EQ(this->normals(mesh, blockCells, 0), expected);
  }
  // Also in an order in which nothing is final before the end.
  const StreamMesh poor = toStream(shuffled(torus(80, 60, 0.3)), TestOrder::Keep);
  EXPECT_EQ(this->normals(poor, 100, 0), this->normals(poor));
}

TEST_F(VertexNormalsTest, DoNotDependOnHowAPlaneAngleIsCut)
{
  // A corner of a cube, where one of the faces is split in two at the corner.
  StreamMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1 };
  mesh.corners = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1 };
  const std::vector<float> normals = this->normals(mesh);
  for (int axis = 0; axis < 3; axis++)
  {
    EXPECT_FLOAT_EQ(normals[axis], float(1 / std::sqrt(3.0)));
  }
}

TEST_F(VertexNormalsTest, LeaveOutWhatHasNoArea)
{
  // A triangle, a point, a line, and a triangle with three equal corners.
  StreamMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 5, 5, 5 };
  mesh.corners = { 0, 1, 2, 1, 3, 1, 1, 3, 4, 5, 5, 5 };
  const std::vector<float> expected{ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  EXPECT_EQ(this->normals(mesh), expected);
}

TEST_F(VertexNormalsTest, LeaveOutFlaggedCells)
{
  StreamMesh mesh;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.corners = { 0, 1, 2, 0, 2, 3, 0, 2, 3 };
  const std::vector<float> twice = this->normals(mesh);
  const std::vector<std::uint8_t> flags{ 0, 0, DuplicateCell };
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  const std::vector<float> once = this->normals(mesh);
  EXPECT_NE(once, twice);
  mesh.cellColumns.clear();
  mesh.corners.resize(6);
  EXPECT_EQ(once, this->normals(mesh));
}

TEST_F(VertexNormalsTest, AreThereForTheSmallestAndTheLargest)
{
  for (const double scale : { 1e-300, 1e-30, 1e30, 1e300 })
  {
    StreamMesh mesh = toStream(sphere(2));
    const std::vector<float> expected = this->normals(mesh);
    for (double& x : mesh.positions)
    {
      x *= scale;
    }
    const std::vector<float> normals = this->normals(mesh);
    for (std::size_t i = 0; i < normals.size(); i++)
    {
      EXPECT_NEAR(normals[i], expected[i], 1e-6);
    }
  }
}

TEST_F(VertexNormalsTest, OfTetrahedraAreRefused)
{
  MemorySource source(toStream(tetBox(3, 3, 3)));
  expectError([&] { VertexNormals normals(source); }, "tetrahedra");
}

TEST_F(VertexNormalsTest, ACancelLeavesNothing)
{
  MemorySource source(toStream(sphere(3)), 10);
  NormalsOptions options;
  options.scratch = this->Folder.path();
  options.progress = [](double done) { return done < 0.5; };
  EXPECT_THROW(VertexNormals(source, options), Cancelled);
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST(CellNormals, FollowTheBlocks)
{
  TemporaryFolder folder;
  const StreamMesh mesh = toStream(sphere(3));
  MemorySource source(mesh, 37);
  CellNormals normals(folder.path(), 0);
  for (MeshBlock block; source.next(block);)
  {
    std::vector<float> values(block.corners.size());
    normals.read(block, values);
    for (std::size_t i = 0; i < values.size(); i += 3)
    {
      // Outward, as the point of the sphere below it.
      double cosine = 0.0, size = 0.0;
      for (std::size_t axis = 0; axis < 3; axis++)
      {
        const double center = mesh.positions[3 * block.corners[i] + axis] +
                              mesh.positions[3 * block.corners[i + 1] + axis] +
                              mesh.positions[3 * block.corners[i + 2] + axis];
        cosine += center * values[i + axis];
        size += center * center;
      }
      EXPECT_GT(cosine / std::sqrt(size), 0.999);
    }
  }
}

TEST(TriangleShape, HasTheAnglesOfATriangle)
{
  const std::array<double, 3> a{ 0, 0, 0 }, b{ 2, 0, 0 }, c{ 0, 2, 0 };
  const TriangleShape shape = shapeOfTriangle(a, b, c);
  EXPECT_EQ(shape.normal, (std::array<double, 3>{ 0, 0, 1 }));
  EXPECT_DOUBLE_EQ(shape.angles[0], std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(shape.angles[1], std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(shape.angles[2], std::numbers::pi / 4);
  EXPECT_EQ(shapeOfTriangle(a, b, b).angles, (std::array<double, 3>{}));
}

} // namespace
} // namespace smg::testing
