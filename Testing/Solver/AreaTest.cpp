// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Area.h"

#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

StreamMesh shuffledTorus()
{
  return toStream(shuffled(torus(40, 20, 0.3)));
}

StreamMesh shuffledBox()
{
  return toStream(shuffled(tetBox(7, 6, 5, 0.2)));
}

Eigen::Vector3d pointOf(const StreamMesh& mesh, std::int64_t vertex)
{
  return Eigen::Vector3d(mesh.positions.data() + 3 * vertex);
}

double sizeOf(const StreamMesh& mesh, std::int64_t cell)
{
  const int count = cornersOf(mesh.cellType);
  const std::int64_t* corner = mesh.corners.data() + count * cell;
  const Eigen::Vector3d p = pointOf(mesh, corner[0]), a = pointOf(mesh, corner[1]) - p,
                        b = pointOf(mesh, corner[2]) - p;
  return count == 3 ? a.cross(b).norm() / 2.0
                    : std::fabs(a.cross(b).dot(pointOf(mesh, corner[3]) - p)) / 6.0;
}

/** Tags 0 to 2 of the cells. */
StreamMesh withTags(StreamMesh mesh)
{
  std::vector<std::int32_t> tags;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    tags.push_back(static_cast<std::int32_t>(
      mesh.corners[static_cast<std::size_t>(cornersOf(mesh.cellType) * c)] % 3));
  }
  mesh.cellColumns.push_back(makeColumn<std::int32_t>("tag", tags));
  return mesh;
}

TEST(Area, SumsAreThoseOfTheCells)
{
  for (const StreamMesh& mesh : { withTags(shuffledTorus()), withTags(shuffledBox()) })
  {
    AreaDescription description;
    description.tag = "tag";
    description.scale = 0.1;
    const auto shares = area(MemoryMesh(mesh), description);
    const Report::Areas& found = *shares->report().areas;
    const double unit = mesh.cellType == CellType::Triangle ? 1e-2 : 1e-3;
    std::map<double, Report::Area> expected;
    Eigen::VectorXd ofVertices = Eigen::VectorXd::Zero(mesh.vertices());
    double total = 0.0;
    const int count = cornersOf(mesh.cellType);
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      const double size = unit * sizeOf(mesh, c);
      const double tag = mesh.cellColumns[0].value(static_cast<std::size_t>(c));
      Report::Area& part = expected.try_emplace(tag, Report::Area{ tag, 0, 0.0 }).first->second;
      ++part.cells;
      part.area += size;
      total += size;
      for (int k = 0; k < count; ++k)
      {
        ofVertices[mesh.corners[static_cast<std::size_t>(count * c + k)]] += size / count;
      }
    }
    EXPECT_EQ(found.isVolume, count == 4);
    EXPECT_EQ(found.cells, mesh.cells());
    EXPECT_NEAR(found.total, total, 1e-12 * total);
    ASSERT_EQ(found.by_tag.size(), expected.size());
    for (const Report::Area& part : found.by_tag)
    {
      EXPECT_EQ(part.cells, expected.at(part.tag).cells);
      EXPECT_NEAR(part.area, expected.at(part.tag).area, 1e-12 * total);
    }
    EXPECT_LT((valuesOf(*shares).col(0) - ofVertices).cwiseAbs().maxCoeff(), 1e-14 * total);
  }
}

/** Points of a triangle by the corner that is nearest, in a fine grid; obtuse ones have no such
 * shares. */
TEST(Area, VoronoiSharesAreWhatIsNearest)
{
  const double height = 0.9;
  StreamMesh mesh;
  mesh.cellType = CellType::Triangle;
  mesh.positions = { 0, 0, 0, 1, 0, 0, 0.4, height, 0 };
  mesh.corners = { 0, 1, 2 };
  AreaDescription description;
  description.share = AreaShare::Voronoi;
  const Eigen::VectorXd shares = valuesOf(*area(MemoryMesh(mesh), description)).col(0);
  constexpr int N = 1500;
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  for (int i = 0; i < N; ++i)
  {
    for (int j = 0; i + j < N; ++j)
    {
      const Eigen::Vector3d p = pointOf(mesh, 0) +
                                (i + 1.0 / 3) / N * (pointOf(mesh, 1) - pointOf(mesh, 0)) +
                                (j + 1.0 / 3) / N * (pointOf(mesh, 2) - pointOf(mesh, 0));
      Eigen::Index k = 0;
      Eigen::Vector3d(
        (p - pointOf(mesh, 0)).norm(), (p - pointOf(mesh, 1)).norm(), (p - pointOf(mesh, 2)).norm())
        .minCoeff(&k);
      nearest[k] += 1.0;
    }
  }
  nearest *= shares.sum() / nearest.sum();
  EXPECT_NEAR(shares.sum(), height / 2.0, 1e-15);
  EXPECT_LT((shares - nearest).cwiseAbs().maxCoeff(), 2e-3);

  // The obtuse corner has half.
  mesh.positions[7] = 0.1;
  const Eigen::VectorXd ofObtuse = valuesOf(*area(MemoryMesh(mesh), description)).col(0);
  EXPECT_NEAR(ofObtuse[2], 0.025, 1e-15);
  EXPECT_NEAR(ofObtuse[0], 0.0125, 1e-15);
}

TEST(Area, OfPartsAreCellsWithAllCornersInThem)
{
  for (const StreamMesh& mesh : { shuffledTorus(), shuffledBox() })
  {
    AreaDescription description;
    description.of = { Region(Region::HalfSpace{ { 1, 0, 0 }, 1.0 }) };
    const auto shares = area(MemoryMesh(mesh), description);
    const int count = cornersOf(mesh.cellType);
    double total = 0.0;
    std::int64_t cells = 0;
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      bool isIn = true;
      for (int k = 0; k < count; ++k)
      {
        isIn = isIn && pointOf(mesh, mesh.corners[static_cast<std::size_t>(count * c + k)])[0] >= 1;
      }
      cells += isIn;
      total += isIn ? sizeOf(mesh, c) : 0.0;
    }
    ASSERT_GT(cells, 0);
    EXPECT_EQ(shares->report().areas->cells, cells);
    EXPECT_NEAR(shares->report().areas->total, total, 1e-12 * total);
  }
}

TEST(Area, ATagOfCellsSelectsThese)
{
  for (const StreamMesh& mesh : { withTags(shuffledTorus()), withTags(shuffledBox()) })
  {
    AreaDescription description;
    description.tag = "tag";
    description.of = { ColumnTag{ "tag", 1 } };
    const auto shares = area(MemoryMesh(mesh), description);
    const Report::Areas& found = *shares->report().areas;
    ASSERT_EQ(found.by_tag.size(), 1U);
    EXPECT_EQ(found.by_tag[0].tag, 1.0);
    // Of two parts, one after the other, the sum.
    description.of.emplace_back(ColumnTag{ "tag", 2 });
    const auto both = area(MemoryMesh(mesh), description);
    EXPECT_EQ(both->report().areas->by_tag.size(), 2U);
    EXPECT_EQ(both->report().areas->by_tag[0].area, found.total);
  }
}

TEST(Area, FlaggedCellsHaveNone)
{
  StreamMesh mesh = shuffledTorus();
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()));
  flags[3] = 1;
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  EXPECT_EQ(area(MemoryMesh(mesh))->report().areas->cells, mesh.cells() - 1);
}

/** A mesh that ends before its counts, or has what is not a position. */
TEST(Area, StreamsAreChecked)
{
  StreamMesh mesh = shuffledTorus();
  mesh.positions[17] = std::nan("");
  EXPECT_NE(messageOf([&] { area(MemoryMesh(mesh)); }), "");
}

TEST(Area, ErrorsNameWhatIsWrong)
{
  const StreamMesh mesh = withTags(shuffledTorus());
  const auto expect = [&mesh](const AreaDescription& description, const std::string& part)
  { expectError([&] { area(MemoryMesh(mesh), description); }, part); };
  AreaDescription description;
  description.tag = "nothing";
  expect(description, "nothing");
  description = {};
  for (const double scale : { 0.0, -1.0, 1e-170, 1e200 })
  {
    description.scale = scale;
    expect(description, "scale: must be above 0");
  }
  description = {};
  description.of = { Region(Region::Sphere{ { 99, 0, 0 }, 1.0 }) };
  expect(description, "of[0]: no cell");
  description = {};
  description.share = AreaShare::Voronoi;
  expectError([&] { area(MemoryMesh(shuffledBox()), description); }, "for triangles");
}

} // namespace
} // namespace smg::testing
