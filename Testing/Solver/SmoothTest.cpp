// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/SmoothTesting.h"
#include "Testing/Solver/SolveTesting.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace smg::testing
{
namespace
{

const StreamMesh Torus = noisy(toStream(torus(36, 18, 0.2)), 0.05);
const StreamMesh Sheet = noisy(toStream(shuffled(grid(24, 17))), 0.15);

/** The largest distance of a vertex from that of the other matrix, in diagonals of it. */
double farthest(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return (a - b).rowwise().norm().maxCoeff() / diagonalOf(b);
}

/** 1 at the vertices of edges of one triangle. */
std::vector<std::uint8_t> onBoundary(const StreamMesh& mesh)
{
  std::map<std::pair<std::int64_t, std::int64_t>, int> uses;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto ends = std::minmax(mesh.corners[3 * c + k], mesh.corners[3 * c + (k + 1) % 3]);
      ++uses[ends];
    }
  }
  std::vector<std::uint8_t> boundary(static_cast<std::size_t>(mesh.vertices()));
  for (const auto& [ends, cells] : uses)
  {
    if (cells == 1)
    {
      boundary[ends.first] = boundary[ends.second] = 1;
    }
  }
  return boundary;
}

} // namespace

TEST(Smooth, AStepIsTheDirectSolve)
{
  const Eigen::MatrixXd x = pointsOf(Torus);
  const Eigen::MatrixXd expected =
    smoothDirectly(lumpedMass(Torus, x), stiffness(Torus, x), timeOf(1.0, 1), x, {});
  EXPECT_GT(farthest(x, expected), 5e-3);
  EXPECT_LT(farthest(smoothed(Torus, plainStep()).values, expected), 1e-9);
}

TEST(Smooth, StepsHaveTheStiffnessAtRestAndTheMassOfTheSurfaceBefore)
{
  Smoothing options = plainStep();
  options.steps = 3;
  Eigen::MatrixXd x = pointsOf(Torus);
  const Eigen::SparseMatrix<double> L = stiffness(Torus, x);
  for (int k = 0; k < 3; ++k)
  {
    x = smoothDirectly(lumpedMass(Torus, x), L, timeOf(1.0, 3), x, {});
  }
  const Solved result = smoothed(Torus, options);
  EXPECT_LT(farthest(result.values, x), 1e-9);
  ASSERT_EQ(result.report.steps.size(), 3U);
  EXPECT_EQ(result.report.steps[2].name, "step 3");
  EXPECT_TRUE(result.report.converged);
}

TEST(Smooth, AFreeBoundaryIsThatOfTheDirectSolveAndAFixedOneDoesNotMove)
{
  const Eigen::MatrixXd x = pointsOf(Sheet);
  const Eigen::VectorXd mass = lumpedMass(Sheet, x);
  const Eigen::SparseMatrix<double> L = stiffness(Sheet, x);
  Smoothing options = plainStep(4.0);
  EXPECT_LT(
    farthest(smoothed(Sheet, options).values, smoothDirectly(mass, L, timeOf(4.0, 1), x, {})),
    1e-9);
  options.boundary = SmoothedBoundary::Fixed;
  const std::vector<std::uint8_t> boundary = onBoundary(Sheet);
  const Eigen::MatrixXd fixed = smoothed(Sheet, options).values;
  EXPECT_LT(farthest(fixed, smoothDirectly(mass, L, timeOf(4.0, 1), x, boundary)), 1e-9);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
  {
    EXPECT_TRUE(!boundary[static_cast<std::size_t>(v)] || fixed.row(v) == x.row(v));
  }
}

TEST(Smooth, ABoundaryIsSmoothedAsCurvesAndHoldsTheSurface)
{
  Smoothing options = plainStep(4.0);
  options.boundary = SmoothedBoundary::Smooth;
  options.steps = 2;
  // The boundary as a dense matrix: finite elements of edges with stiffness at rest.
  const std::vector<std::uint8_t> boundary = onBoundary(Sheet);
  const Eigen::MatrixXd rest = pointsOf(Sheet);
  Eigen::MatrixXd x = rest;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(x.rows(), x.rows());
  std::map<std::pair<std::int64_t, std::int64_t>, int> uses;
  for (std::int64_t c = 0; c < Sheet.cells(); ++c)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++uses[std::minmax(Sheet.corners[3 * c + k], Sheet.corners[3 * c + (k + 1) % 3])];
    }
  }
  std::erase_if(uses, [](const auto& edge) { return edge.second != 1; });
  for (const auto& [ends, cells] : uses)
  {
    const double weight = 1.0 / (x.row(ends.first) - x.row(ends.second)).norm();
    L(ends.first, ends.first) += weight;
    L(ends.second, ends.second) += weight;
    L(ends.first, ends.second) -= weight;
    L(ends.second, ends.first) -= weight;
  }
  const double t = timeOf(4.0, 2);
  const Eigen::SparseMatrix<double> surface = stiffness(Sheet, rest);
  for (int k = 0; k < 2; ++k)
  {
    const Eigen::VectorXd surfaceMass = lumpedMass(Sheet, x);
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(x.rows());
    for (const auto& [ends, cells] : uses)
    {
      const double half = 0.5 * (x.row(ends.first) - x.row(ends.second)).norm();
      mass[ends.first] += half;
      mass[ends.second] += half;
    }
    Eigen::MatrixXd matrix = t * L;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
    {
      matrix(v, v) += boundary[static_cast<std::size_t>(v)] ? mass[v] : 1.0;
      mass[v] = boundary[static_cast<std::size_t>(v)] ? mass[v] : 1.0;
    }
    x = matrix.ldlt().solve(mass.asDiagonal() * x).eval();
    x = smoothDirectly(surfaceMass, surface, t, x, boundary);
  }
  EXPECT_GT(farthest(rest, x), 1e-3);
  EXPECT_LT(farthest(smoothed(Sheet, options).values, x), 1e-9);
}

TEST(Smooth, WhatIsHeldDoesNotMoveByABit)
{
  for (const auto boundary :
    { SmoothedBoundary::Smooth, SmoothedBoundary::Fixed, SmoothedBoundary::Free })
  {
    Smoothing options;
    options.boundary = boundary;
    options.steps = 2;
    options.hold = { Region::Sphere{ { 3, 3, 0 }, 3 }, Region::Vertices{ { 0, 5, 100 } } };
    const Eigen::MatrixXd x = pointsOf(Sheet);
    const Eigen::MatrixXd y = smoothed(Sheet, options).values;
    int held = 0;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
    {
      const bool isHeld =
        (x.row(v) - Eigen::RowVector3d(3, 3, 0)).norm() <= 3 || v == 0 || v == 5 || v == 100;
      EXPECT_TRUE(!isHeld || x.row(v) == y.row(v)) << v;
      held += isHeld ? 1 : 0;
    }
    EXPECT_GT(held, 10);
    EXPECT_GT((x - y).rowwise().norm().maxCoeff(), 0.05);
  }
}

TEST(Smooth, TheVolumeOfAClosedSurfaceIsKept)
{
  const StreamMesh ball = noisy(toStream(sphere(4)), 0.02);
  const Eigen::MatrixXd x = pointsOf(ball);
  const double volume = enclosedVolume(ball, x);
  Smoothing options;
  options.size = { 1.0, SmoothingSize::Mesh };
  options.steps = 2;
  const Solved kept = smoothed(ball, options);
  EXPECT_NEAR(enclosedVolume(ball, kept.values), volume, 1e-12 * volume);
  ASSERT_TRUE(kept.report.volume.has_value());
  EXPECT_NEAR(kept.report.volume->before, volume, 1e-12 * volume);
  EXPECT_NEAR(kept.report.volume->after, volume, 1e-12 * volume);
  EXPECT_TRUE(kept.report.notes.empty());
  // It is a better sphere than before.
  const auto roughness = [](const Eigen::MatrixXd& points)
  {
    const Eigen::VectorXd radii = points.rowwise().norm();
    return std::sqrt((radii.array() - radii.mean()).square().mean());
  };
  EXPECT_LT(roughness(kept.values), 0.15 * roughness(x));

  options.keepVolume = false;
  const Solved shrunk = smoothed(ball, options);
  const double less = enclosedVolume(ball, shrunk.values);
  EXPECT_LT(less, 0.97 * volume);
  EXPECT_NEAR(shrunk.report.volume->after, less, 1e-12 * volume);
  EXPECT_NEAR(shrunk.report.volume->swept, less - volume, 1e-12 * volume);
}

/** A band that is twisted once, with a boundary. */
IndexedTestMesh moebius(int n)
{
  IndexedTestMesh mesh;
  for (int i = 0; i < n; ++i)
  {
    const double turn = 2.0 * std::numbers::pi * i / n;
    for (const double side : { -0.3, 0.3 })
    {
      const double radius = 1.0 + side * std::cos(0.5 * turn);
      mesh.positions.insert(mesh.positions.end(),
        { radius * std::cos(turn), radius * std::sin(turn), side * std::sin(0.5 * turn) });
    }
    const std::int64_t a = 2 * i, b = a + 1;
    const std::int64_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    mesh.corners.insert(mesh.corners.end(), { a, c, b, b, c, d });
  }
  return mesh;
}

/** Smooths a mesh; the values are in its own order. */
Solved ordered(const IndexedTestMesh& mesh, std::int64_t blockCells)
{
  Smoothing options;
  options.size = { 0.5, SmoothingSize::Mesh };
  options.tolerance = 1e-10;
  const StreamMesh stream = toStream(mesh, TestOrder::Keep);
  Solved found = smoothed(stream, options, blockCells);
  const Eigen::MatrixXd inStream = found.values;
  for (std::int64_t v = 0; v < stream.vertices(); ++v)
  {
    found.values.row(stream.originalIds[static_cast<std::size_t>(v)]) = inStream.row(v);
  }
  return found;
}

TEST(Smooth, AnyWindingGivesTheSurfaceThatIsWoundWell)
{
  const IndexedTestMesh ball = sphere(3);
  const IndexedTestMesh hollow =
    disjointUnion(ball, turned(resized(ball, 0.6), [](std::int64_t) { return true; }));
  const std::vector<std::pair<std::string, IndexedTestMesh>> surfaces{ { "a ball", ball },
    { "two balls", disjointUnion(ball, resized(ball, 0.5), { 3, 0, 0 }) },
    { "a torus", torus(40, 20, 0.2) }, { "an open surface", grid(20, 20, 0.1) },
    { "a ball and a grid", disjointUnion(ball, grid(9, 9), { 0, 0, 4 }) } };
  for (const auto& [name, surface] : surfaces)
  {
    SCOPED_TRACE(name);
    const Solved well = ordered(surface, 1000);
    EXPECT_TRUE(well.report.warnings.empty());
    Random random(3);
    const std::int64_t bodyCells = ball.cells();
    const std::vector<std::function<bool(std::int64_t)>> windings{ [](std::int64_t)
      { return true; },
      [](std::int64_t c) { return c % 2 == 0; }, [](std::int64_t c) { return c == 7; },
      [&random](std::int64_t) { return random.below(3) == 0; },
      // The side of an open body is that of most of its triangles.
      [bodyCells, &name](std::int64_t c) { return c >= bodyCells && name == "two balls"; } };
    for (const auto& winding : windings)
    {
      for (const std::int64_t blockCells : { 1000, 17 })
      {
        const Solved found = ordered(turned(surface, winding), blockCells);
        EXPECT_LE((found.values - well.values).norm(), 1e-9 * well.values.norm());
        EXPECT_TRUE(found.report.warnings.empty());
        if (std::isnan(well.report.volume->before))
        {
          EXPECT_TRUE(std::isnan(found.report.volume->before));
          continue;
        }
        EXPECT_NEAR(found.report.volume->before, well.report.volume->before,
          1e-12 * well.report.volume->before);
        EXPECT_NEAR(
          found.report.volume->after, well.report.volume->after, 1e-9 * well.report.volume->before);
      }
    }
  }
  // A cavity is wound inwards, and stays so; what is inside out by itself does not.
  for (const bool isInsideOut : { false, true })
  {
    const Solved cavity = ordered(turned(hollow, [=](std::int64_t) { return isInsideOut; }), 1000);
    EXPECT_NEAR(cavity.report.volume->before,
      enclosedVolume(toStream(ball), positionsOf(toStream(ball))) * (1.0 - 0.216), 1e-9);
    ASSERT_EQ(cavity.report.warnings.size(), 1U);
    EXPECT_NE(cavity.report.warnings.front().find("as cavities are"), std::string::npos);
  }
}

TEST(Smooth, ASurfaceWithoutSidesHasNoVolume)
{
  const Solved band = ordered(moebius(40), 1000);
  EXPECT_TRUE(std::isnan(band.report.volume->before));
  ASSERT_EQ(band.report.warnings.size(), 1U);
  EXPECT_NE(band.report.warnings.front().find("1 body cannot be wound"), std::string::npos);
  // Three triangles at an edge: no two sides to be wound against.
  StreamMesh fins;
  fins.positions = { 0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, -1, -1, 0 };
  fins.corners = { 0, 1, 2, 0, 1, 3, 1, 0, 4 };
  Smoothing options;
  options.size = { 0.1, SmoothingSize::Mesh };
  for (const std::string& note : smoothed(fins, options).report.notes)
  {
    EXPECT_EQ(note.find("wound"), std::string::npos) << note;
  }
}

TEST(Smooth, AnOpenSurfaceSweepsNoVolume)
{
  // A dome: smoothing with a fixed boundary flattens it.
  StreamMesh dome = Sheet;
  for (std::int64_t v = 0; v < dome.vertices(); ++v)
  {
    const double x = dome.positions[3 * v] - 12.0;
    dome.positions[3 * v + 2] += 0.02 * (200.0 - x * x);
  }
  Smoothing options = plainStep(10.0);
  options.boundary = SmoothedBoundary::Fixed;
  const Solved flattened = smoothed(dome, options);
  EXPECT_TRUE(std::isnan(flattened.report.volume->before));
  EXPECT_LT(std::fabs(flattened.report.volume->swept), 1e3);
  options.keepVolume = true;
  const Solved kept = smoothed(dome, options);
  EXPECT_NEAR(kept.report.volume->swept, 0.0, 1e-9 * std::fabs(flattened.report.volume->swept));
  EXPECT_GT(std::fabs(flattened.report.volume->swept), 1.0);
}

TEST(Smooth, AColumnIsSmoothedLikePositions)
{
  StreamMesh box = toStream(tetBox(9, 8, 7, 0.1));
  Random random(3);
  std::vector<float> noise(static_cast<std::size_t>(2 * box.vertices()));
  std::ranges::generate(noise, [&] { return static_cast<float>(random.uniform()); });
  box.vertexColumns = { makeColumn<float>("noise", noise, 2) };
  Eigen::MatrixXd u(box.vertices(), 2);
  for (std::size_t k = 0; k < noise.size(); ++k)
  {
    u(static_cast<Eigen::Index>(k / 2), static_cast<Eigen::Index>(k % 2)) = noise[k];
  }
  Smoothing options = plainStep(4.0);
  options.boundary.reset();
  options.column = "noise";
  options.steps = 2;
  const Eigen::MatrixXd points = pointsOf(box);
  const Eigen::VectorXd mass = lumpedMass(box, points);
  const Eigen::SparseMatrix<double> L = stiffness(box, points);
  Eigen::MatrixXd expected = u;
  for (int k = 0; k < 2; ++k)
  {
    expected = smoothDirectly(mass, L, timeOf(4.0, 2), expected, {});
  }
  const Solved result = smoothed(box, options);
  EXPECT_LT((result.values - expected).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_GT((u - expected).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_FALSE(result.report.volume.has_value());
  // The mean is kept.
  EXPECT_NEAR(mass.dot(result.values.col(1)), mass.dot(u.col(1)), 1e-9 * mass.sum());
}

TEST(Smooth, WavesOfTheSizeAreHalvedByAnyNumberOfSteps)
{
  // A wave along x that is even at both ends.
  StreamMesh strip = toStream(grid(161, 7));
  const double length = 160.0;
  std::vector<double> wave;
  for (std::int64_t v = 0; v < strip.vertices(); ++v)
  {
    wave.push_back(std::cos(2.0 * std::numbers::pi * strip.positions[3 * v] / (length / 4.0)));
  }
  strip.vertexColumns = { makeColumn<double>("wave", wave) };
  Smoothing options;
  options.column = "wave";
  options.size = { length / 4.0, SmoothingSize::Mesh };
  for (const int steps : { 1, 5 })
  {
    options.steps = steps;
    const Eigen::MatrixXd values = smoothed(strip, options).values;
    // Rows of the lattice are shifted by half an edge: the middle of the strip.
    for (std::int64_t v = 0; v < strip.vertices(); ++v)
    {
      if (std::fabs(strip.positions[3 * v] - 0.5 * length) < 20.0)
      {
        EXPECT_NEAR(values(v, 0), 0.5 * wave[static_cast<std::size_t>(v)], 0.01);
      }
    }
  }
}

TEST(Smooth, SizesAreInTheUnitOfTheMeshInEdgesOrInDiagonals)
{
  const Eigen::MatrixXd x = pointsOf(Torus);
  double lengths = 0.0;
  for (std::int64_t k = 0; k < 3 * Torus.cells(); ++k)
  {
    const std::int64_t next = k % 3 == 2 ? k - 2 : k + 1;
    lengths += (x.row(Torus.corners[k]) - x.row(Torus.corners[next])).norm();
  }
  const double edge = lengths / static_cast<double>(3 * Torus.cells());
  Smoothing options = plainStep(4.0 * edge);
  const Eigen::MatrixXd expected = smoothed(Torus, options).values;
  options.size = SmoothingSize{};
  EXPECT_LT(farthest(smoothed(Torus, options).values, expected), 1e-12);
  options.size = { 4.0 * edge / diagonalOf(x), SmoothingSize::Diagonal };
  EXPECT_LT(farthest(smoothed(Torus, options).values, expected), 1e-12);
}

TEST(Smooth, CellsWithoutAreaAndDuplicatesDoNoHarm)
{
  StreamMesh mesh = Torus;
  const std::vector<std::int64_t> corners(mesh.corners.begin(), mesh.corners.begin() + 3);
  mesh.corners.insert(mesh.corners.begin() + 3, corners.begin(), corners.end());
  mesh.corners.insert(mesh.corners.begin() + 3, { corners[0], corners[0], corners[1] });
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(mesh.cells()));
  flags[1] = DegenerateCell;
  flags[2] = DuplicateCell;
  mesh.cellColumns = { makeColumn<std::uint8_t>(CellFlagsName, flags) };
  Smoothing options;
  options.steps = 2;
  const Solved result = smoothed(mesh, options);
  EXPECT_TRUE(sameBits(result.values, smoothed(Torus, options).values));
  EXPECT_FALSE(std::isnan(result.report.volume->before));
}

} // namespace smg::testing
