// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Results/MovedPoints.h"

#include "Testing/Support/MemorySource.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TestMeshes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace smg::testing
{
namespace
{

using PointMotion = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/** The positions of a mesh after a motion of each vertex. */
class MovedVerticesInMemory : public Solution
{
public:
  MovedVerticesInMemory(const StreamMesh& mesh, const PointMotion& motion)
    : Values(mesh.positions)
  {
    for (std::size_t i = 0; i < this->Values.size(); i += 3)
    {
      Eigen::Map<Eigen::Vector3d> point(&this->Values[i]);
      point = motion(Eigen::Vector3d(point));
    }
  }
  std::int64_t vertices() const override
  {
    return static_cast<std::int64_t>(this->Values.size() / 3);
  }
  int columns() const override { return 3; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    std::copy_n(this->Values.begin() + 3 * first, 3 * count, values.begin());
  }
  const Report& report() const override { return this->Said; }

  std::vector<double> Values;

private:
  Report Said;
};

/** What is found when the moved mesh is read in blocks of so many cells. */
Report judged(const StreamMesh& mesh, Solution& moved, std::int64_t blockCells = 37)
{
  Report report;
  MovedPoints stream(std::make_unique<MemorySource>(mesh, blockCells), moved, &report);
  for (MeshBlock block; stream.next(block);)
  {
    EXPECT_FALSE(report.inverted);
  }
  return report;
}

std::int64_t invertedBy(const StreamMesh& mesh, const PointMotion& motion)
{
  MovedVerticesInMemory moved(mesh, motion);
  const Report report = judged(mesh, moved);
  EXPECT_EQ(report.notes.size(), report.inverted->cells > 0 ? 1U : 0U);
  return report.inverted->cells;
}

/** The linear map of cell c, from the edges at rest to the moved ones, in its own dimension. */
Eigen::MatrixXd mapOf(const StreamMesh& mesh, const std::vector<double>& moved, std::int64_t c)
{
  const int corners = cornersOf(mesh.cellType);
  Eigen::MatrixXd rest(3, corners - 1), after(3, corners - 1);
  const std::int64_t* corner = &mesh.corners[c * corners];
  for (int k = 1; k < corners; ++k)
  {
    const auto edge = [&](const std::vector<double>& points)
    {
      return Eigen::Vector3d(Eigen::Vector3d::Map(&points[3 * corner[k]]) -
                             Eigen::Vector3d::Map(&points[3 * corner[0]]));
    };
    rest.col(k - 1) = edge(mesh.positions);
    after.col(k - 1) = edge(moved);
  }
  if (corners == 4)
  {
    return after * rest.inverse();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> plane(rest);
  const Eigen::MatrixXd within =
    Eigen::MatrixXd(plane.matrixQR().topRows(2)).triangularView<Eigen::Upper>();
  return after * within.inverse();
}

/** The inverted cells and the worst of them, from determinants and singular values. */
Report::Inverted invertedDirectly(const StreamMesh& mesh, const std::vector<double>& moved)
{
  const bool isSurface = mesh.cellType == CellType::Triangle;
  Report::Inverted found;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const Eigen::MatrixXd map = mapOf(mesh, moved, c);
    const Eigen::VectorXd stretches = map.jacobiSvd().singularValues();
    const double ratio = isSurface ? stretches(1) / stretches(0) : map.determinant();
    if (ratio <= (isSurface ? 1e-3 : 0.0))
    {
      ++found.cells;
      if (found.worst < 0 || ratio < found.ratio)
      {
        found.worst = c;
        found.ratio = ratio;
      }
    }
  }
  found.share = static_cast<double>(found.cells) / static_cast<double>(mesh.cells());
  return found;
}

void expectSameCells(const Report::Inverted& a, const Report::Inverted& b)
{
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.share, b.share);
  EXPECT_EQ(a.worst, b.worst);
  EXPECT_NEAR(a.ratio, b.ratio, 1e-9 * std::fabs(b.ratio));
}

PointMotion turnedAndScaled(double scale)
{
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  return [=](const Eigen::Vector3d& p)
  { return Eigen::Vector3d(scale * (turn * p) + Eigen::Vector3d(3, -7, 2)); };
}

} // namespace

TEST(InvertedCells, ASimilarityInvertsNothingAReflectionEveryTetrahedron)
{
  const StreamMesh solid = toStream(shuffled(tetBox(5, 5, 5, 0.2)));
  const StreamMesh surface = toStream(shuffled(torus(20, 10, 0.2)));
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    EXPECT_EQ(invertedBy(solid, turnedAndScaled(scale)), 0);
    EXPECT_EQ(invertedBy(surface, turnedAndScaled(scale)), 0);
    // A point reflection reverses volumes, and not what a triangle has in space.
    EXPECT_EQ(invertedBy(solid, turnedAndScaled(-scale)), solid.cells());
    EXPECT_EQ(invertedBy(surface, turnedAndScaled(-scale)), 0);
  }
}

TEST(InvertedCells, WhatBecomesFlatOrAPointVanishes)
{
  const StreamMesh solid = toStream(tetBox(5, 5, 5, 0.2));
  const StreamMesh surface = toStream(torus(20, 10, 0.2));
  for (const StreamMesh* mesh : { &solid, &surface })
  {
    MovedVerticesInMemory point(
      *mesh, [](const Eigen::Vector3d&) { return Eigen::Vector3d(1, 2, 3); });
    const Report report = judged(*mesh, point);
    EXPECT_EQ(report.inverted->cells, mesh->cells());
    EXPECT_EQ(report.inverted->share, 1.0);
    EXPECT_EQ(report.inverted->worst, 0);
    EXPECT_EQ(report.inverted->ratio, 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(report.inverted->place[axis], axis + 1.0, 1e-12);
    }
    EXPECT_EQ(
      invertedBy(*mesh, [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), 0, 0); }),
      mesh->cells());
  }
  const PointMotion flat = [](const Eigen::Vector3d& p)
  { return Eigen::Vector3d(p.x(), p.y(), 0); };
  EXPECT_EQ(invertedBy(solid, flat), solid.cells());
}

TEST(InvertedCells, AreThoseOfDeterminantsAndSingularValuesWhateverTheBlocks)
{
  const StreamMesh solid = toStream(shuffled(tetBox(8, 8, 8, 0.2)));
  const StreamMesh surface = toStream(shuffled(torus(60, 30, 0.2)));
  // Folds of the solid; of the surface compressions by factors from 1 to 1e5.
  const PointMotion fold = [](const Eigen::Vector3d& p)
  { return Eigen::Vector3d(p.x() + 0.4 * std::sin(9 * p.x()), p.y(), p.z() + p.x() * p.y()); };
  const PointMotion press = [](const Eigen::Vector3d& p)
  {
    const double size = std::pow(10.0, -3.0 - p.z());
    return Eigen::Vector3d(p.x() + p.y(), size * (p.x() - p.y()), size * p.z());
  };
  for (const auto& [mesh, motion] : { std::pair(&solid, fold), std::pair(&surface, press) })
  {
    MovedVerticesInMemory moved(*mesh, motion);
    const Report::Inverted should = invertedDirectly(*mesh, moved.Values);
    EXPECT_GT(should.cells, 5);
    EXPECT_LT(should.cells, mesh->cells() / 2);
    const Report whole = judged(*mesh, moved, mesh->cells());
    expectSameCells(*whole.inverted, should);
    for (const std::int64_t block : { 1, 7, 100 })
    {
      EXPECT_EQ(judged(*mesh, moved, block).json(), whole.json()) << block;
    }
  }
}

TEST(InvertedCells, AreNumberedAsInTheFile)
{
  StreamMesh mesh = toStream(tetBox(3, 3, 3));
  std::vector<std::int64_t> numbers;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    numbers.push_back(5000 - c);
  }
  const PointMotion fold = [](const Eigen::Vector3d& p)
  { return Eigen::Vector3d(std::fabs(p.x() - 0.6), p.y(), p.z()); };
  MovedVerticesInMemory moved(mesh, fold);
  const Report plain = judged(mesh, moved);
  mesh.cellColumns.push_back(makeColumn<std::int64_t>(OriginalCellIdName, numbers));
  const Report numbered = judged(mesh, moved);
  EXPECT_EQ(numbered.inverted->worst, 5000 - plain.inverted->worst);
  const auto says = [](const Report& report, const std::string& part)
  { return report.notes[0].find(part) != std::string::npos; };
  EXPECT_TRUE(says(plain, "cell " + std::to_string(plain.inverted->worst) + " of the stream"));
  EXPECT_TRUE(
    says(numbered, "cell " + std::to_string(numbered.inverted->worst) + " of the original mesh"));
  EXPECT_TRUE(says(plain,
    std::to_string(plain.inverted->cells) + " of " + std::to_string(mesh.cells()) + " tetrahedra"));
  EXPECT_NE(numbered.json().find("\"inverted\""), std::string::npos);
}

TEST(InvertedCells, ThatHaveNoWeightOrAreFlatAtRestDoNotCount)
{
  StreamMesh mesh = toStream(tetBox(3, 3, 3));
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()), 0);
  flags[0] = DuplicateCell;
  flags[5] = DegenerateCell;
  mesh.cellColumns.push_back(makeColumn<std::uint8_t>(CellFlagsName, flags));
  EXPECT_EQ(invertedBy(mesh, turnedAndScaled(-1.0)), mesh.cells() - 2);

  // The sign of a volume that is all rounding means nothing.
  for (double& x : mesh.positions)
  {
    x = 0.1 * x + 1000.0;
  }
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3)
  {
    mesh.positions[i] = std::nextafter(1000.0, i % 2 == 0 ? 0.0 : 2000.0);
  }
  EXPECT_EQ(invertedBy(mesh, turnedAndScaled(-1.0)), 0);
}

} // namespace smg::testing
