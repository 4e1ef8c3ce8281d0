// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/StreamPreview.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TestMeshes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace smg::testing
{
namespace
{

void expectVerticesOf(const StreamMesh& mesh, const MeshPiece& preview)
{
  ASSERT_EQ(preview.positions.size(), 3 * preview.ids.size());
  EXPECT_TRUE(std::is_sorted(preview.ids.begin(), preview.ids.end()));
  for (std::size_t i = 0; i < preview.ids.size(); ++i)
  {
    ASSERT_LT(preview.ids[i], mesh.vertices());
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_EQ(preview.positions[3 * i + k], mesh.positions[3 * preview.ids[i] + k]);
    }
  }
}

/** All points are used, and no three points form two triangles. */
void expectProperTriangles(const MeshPiece& preview)
{
  std::set<std::array<std::int64_t, 3>> known;
  std::set<std::int64_t> used;
  for (std::size_t i = 0; i < preview.corners.size(); i += 3)
  {
    std::array<std::int64_t, 3> triangle{ preview.corners[i], preview.corners[i + 1],
      preview.corners[i + 2] };
    used.insert(triangle.begin(), triangle.end());
    std::sort(triangle.begin(), triangle.end());
    EXPECT_LT(triangle[0], triangle[1]);
    EXPECT_LT(triangle[1], triangle[2]);
    EXPECT_TRUE(known.insert(triangle).second);
  }
  EXPECT_EQ(used.size(), preview.ids.size());
}

/** Normals of a sphere, which stay close to those of the mesh, and triangles that face outwards. */
TEST(StreamPreview, IsShadedAsTheMesh)
{
  MemorySource source(toStream(sphere(5)));
  const MeshPiece preview = makePreview(source, 800);
  ASSERT_LT(preview.ids.size(), 801U);
  ASSERT_EQ(preview.normals.size(), preview.positions.size());
  const auto point = [&](std::int64_t i)
  { return Eigen::Vector3d(preview.positions.data() + 3 * i); };
  for (std::size_t i = 0; i < preview.ids.size(); ++i)
  {
    const Eigen::Vector3d normal = Eigen::Vector3f(preview.normals.data() + 3 * i).cast<double>();
    EXPECT_NEAR(normal.norm(), 1.0, 1e-6);
    EXPECT_GT(normal.dot(point(static_cast<std::int64_t>(i)).normalized()), 0.95);
  }
  for (std::size_t t = 0; t < preview.corners.size(); t += 3)
  {
    const Eigen::Vector3d a = point(preview.corners[t]);
    const Eigen::Vector3d b = point(preview.corners[t + 1]);
    EXPECT_GT((b - a).cross(point(preview.corners[t + 2]) - a).dot(a + b), 0.0);
  }
}

TEST(StreamPreview, IsBoundedAndMadeOfVertices)
{
  for (const std::int64_t limit : { 8, 100, 1000, 5000 })
  {
    MemorySource source(toStream(torus(150, 100, 0.2)));
    const MeshPiece preview = makePreview(source, limit);
    EXPECT_LE(std::int64_t(preview.ids.size()), limit);
    EXPECT_GE(std::int64_t(preview.ids.size()), limit < 100 ? 4 : limit * 7 / 10);
    expectVerticesOf(source.mesh(), preview);
    expectProperTriangles(preview);
  }
}

TEST(StreamPreview, HasNearlyAsManyPointsAsAreAskedFor)
{
  const StreamMesh mesh = toStream(torus(300, 200, 0.1));
  Combinations combinations;
  for (std::int64_t limit = 500; limit < 40000; limit = limit * 5 / 4)
  {
    if (!combinations.next())
    {
      continue;
    }
    MemorySource source(mesh);
    const MeshPiece preview = makePreview(source, limit);
    EXPECT_LE(std::int64_t(preview.ids.size()), limit);
    EXPECT_GE(std::int64_t(preview.ids.size()), limit * 7 / 10) << limit;
    expectProperTriangles(preview);
    // A closed surface has two triangles per point; few are lost at folds.
    const auto points = static_cast<double>(preview.ids.size());
    EXPECT_NEAR(static_cast<double>(preview.corners.size()) / 3.0, 2.0 * points, 0.1 * points);
  }
}

TEST(StreamPreview, SmallMeshStaysAsItIs)
{
  MemorySource source(toStream(sphere(2)));
  const MeshPiece preview = makePreview(source, 1000);
  EXPECT_EQ(std::int64_t(preview.ids.size()), source.mesh().vertices());
  EXPECT_EQ(std::int64_t(preview.corners.size() / 3), source.mesh().cells());
}

TEST(StreamPreview, BlocksDoNotMatter)
{
  MemorySource one(toStream(tetBox(12, 12, 12, 0.1)), 1000000);
  MemorySource many(toStream(tetBox(12, 12, 12, 0.1)), 7);
  const MeshPiece a = makePreview(one, 10000);
  const MeshPiece b = makePreview(many, 10000);
  EXPECT_EQ(a.ids, b.ids);
  EXPECT_EQ(a.corners.size(), b.corners.size());
}

TEST(StreamPreview, OfAVolumeIsItsClosedSurface)
{
  MemorySource source(toStream(tetBox(15, 14, 13, 0.1)), 50);
  const MeshPiece preview = makePreview(source, 100000);
  EXPECT_EQ(preview.corners.size() / 3, 4U * (14 * 13 + 13 * 12 + 14 * 12));
  expectVerticesOf(source.mesh(), preview);
  // Outward orientation: every edge is used once in each direction.
  std::map<std::pair<std::int64_t, std::int64_t>, int> edges;
  for (std::size_t i = 0; i < preview.corners.size(); i += 3)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[{ preview.corners[i + k], preview.corners[i + (k + 1) % 3] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({ edge.second, edge.first }), 1U);
  }
}

TEST(StreamPreview, OnePointMeshesDoNotFail)
{
  IndexedTestMesh mesh;
  mesh.positions.assign(9, 1.0);
  mesh.corners = { 0, 1, 2 };
  MemorySource source(toStream(mesh));
  EXPECT_EQ(makePreview(source, 100).corners.size(), 3U);
}

/** The mesh in blocks, without any information before they arrive. */
class UnknownSource : public MeshSource
{
public:
  UnknownSource(const StreamMesh& mesh, std::int64_t blockCells)
    : Source(mesh, blockCells)
    , Info(this->Source.info())
  {
    this->Info.bounds = {};
    this->Info.vertices = this->Info.cells = 0;
  }

  const StreamInfo& info() const override { return this->Info; }
  bool next(MeshBlock& block) override { return this->Source.next(block); }

private:
  MemorySource Source;
  StreamInfo Info;
};

TEST(StreamPreview, BoundsNeedNotBeKnown)
{
  const StreamMesh mesh = toStream(torus(150, 100, 0.2));
  for (const std::int64_t limit : { 8, 100, 1000, 5000 })
  {
    for (const std::int64_t blockCells : { 1, 1000, 1000000 })
    {
      UnknownSource source(mesh, blockCells);
      const MeshPiece preview = makePreview(source, limit);
      EXPECT_LE(std::int64_t(preview.ids.size()), limit);
      EXPECT_GE(std::int64_t(preview.ids.size()), limit < 100 ? 0 : limit * 7 / 10);
      expectVerticesOf(mesh, preview);
      expectProperTriangles(preview);
    }
  }
  UnknownSource source(toStream(sphere(2)), 3);
  EXPECT_EQ(makePreview(source, 1000).ids.size(), 162U);
}

TEST(StreamPreview, HasTheColumnsOfItsVertices)
{
  StreamMesh mesh = toStream(torus(150, 100, 0.2));
  std::vector<float> values;
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i < mesh.vertices(); ++i)
  {
    ids.push_back(7 * i);
    values.insert(values.end(), { float(i), 0.5F * float(i) });
  }
  mesh.vertexColumns = { makeColumn<float>("Values", values, 2),
    makeColumn<std::int64_t>("Ids", ids) };
  for (const std::int64_t limit : { 100, 3000, 100000 })
  {
    MemorySource source(mesh, 70);
    const MeshPiece preview = makePreview(source, limit);
    ASSERT_EQ(preview.vertexColumns.size(), 2U);
    EXPECT_EQ(preview.vertexColumns[0].spec, mesh.vertexColumns[0].spec);
    for (std::size_t i = 0; i < preview.ids.size(); ++i)
    {
      ASSERT_EQ(preview.vertexColumns[0].value(i, 1), 0.5 * double(preview.ids[i]));
      ASSERT_EQ(preview.vertexColumns[1].value(i), 7.0 * double(preview.ids[i]));
    }
  }
}

TEST(StreamPreview, CanBeCancelled)
{
  MemorySource source(toStream(torus(50, 40)), 10);
  EXPECT_THROW(makePreview(source, 100, [](double done) { return done < 0.5; }), Cancelled);
}

} // namespace
} // namespace smg::testing
