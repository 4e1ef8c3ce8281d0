// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CoincidentPoints.h"

#include "Testing/Solver/EllipticTesting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace smg::testing
{
namespace
{

/** The warning of a solve on two cubes of 5^3 vertices, the second one moved. */
std::string warningOf(const std::array<double, 3>& moved, SolveOptions options = {})
{
  const IndexedTestMesh cube = tetBox(5, 5, 5);
  const StreamMesh mesh = toStream(shuffled(disjointUnion(cube, cube, moved)));
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back(
    { below(0, 0.5), columnsOf(1, [](const Point&, int) { return 1.0; }) });
  const Solved solved = solveMesh(mesh, problem, options);
  for (const std::string& warning : solved.report.warnings)
  {
    if (warning.find("coincide") != std::string::npos)
    {
      return warning;
    }
  }
  return {};
}

std::size_t says(const std::string& text, const std::string& part)
{
  return text.find(part) == std::string::npos ? 0 : 1;
}

} // namespace

TEST(CoincidentPoints, OfBodiesAreReported)
{
  // A whole face, an edge, a corner.
  EXPECT_TRUE(says(warningOf({ 4, 0, 0 }), "at 25 places (the mesh has 2 bodies)"));
  EXPECT_TRUE(says(warningOf({ 4, 4, 0 }), "at 5 places"));
  EXPECT_TRUE(says(warningOf({ 4, 4, 4 }), "at 1 place "));
  EXPECT_TRUE(says(warningOf({ 4, 0, 0 }), "--weld"));
  EXPECT_EQ(warningOf({ 4.5, 0, 0 }), "");
  EXPECT_EQ(warningOf({ 4, 9, 0 }), "");
}

TEST(CoincidentPoints, AreFoundOutOfCoreAndWithThreads)
{
  SolveOptions options;
  options.threads = 2;
  options.inCore = false;
  options.coreNodes = 30;
  EXPECT_EQ(warningOf({ 4, 0, 0 }, options), warningOf({ 4, 0, 0 }));
}

TEST(CoincidentPoints, AreEstimatedFromASample)
{
  // Two bodies of 40,000 points each, of which 10,000 coincide; and 1,000 points of one body at one
  // place.
  Components components(1);
  const std::int32_t labels[] = { components.add(), components.add(), components.add() };
  components.join(labels[1], labels[2]);
  CoincidentPoints exact, sampled(4096);
  for (int k = 0; k < 40000; ++k)
  {
    const double a[3] = { 0.001 * k, std::sin(k), 0.0 };
    const double b[3] = { 0.001 * k, std::sin(k), k < 10000 ? -0.0 : 1.0 };
    const double c[3] = { 7, 7, 7 };
    for (CoincidentPoints* points : { &exact, &sampled })
    {
      points->add(a, labels[0]);
      points->add(b, labels[1 + k % 2]);
      points->add(k < 1000 ? c : b, labels[1 + k % 2]);
    }
  }
  EXPECT_FALSE(sampled.count(components).isExact);
  EXPECT_NEAR(static_cast<double>(sampled.count(components).places), 10000.0, 1500.0);
  // Within one body nothing is counted, whichever of its labels the points have.
  components.join(labels[0], labels[1]);
  EXPECT_EQ(sampled.count(components).places, 0);
  EXPECT_EQ(exact.count(components).places, 0);
}

TEST(CoincidentPoints, DoNotTakeMoreMemoryAtOnePlace)
{
  Components components(1);
  const std::int32_t one = components.add(), other = components.add();
  CoincidentPoints points(100);
  const double place[3] = { 1, 2, 3 };
  for (int k = 0; k < 100000; ++k)
  {
    points.add(place, k % 2 == 0 ? one : other);
  }
  EXPECT_LE(points.count(components).places, 1);
}

} // namespace smg::testing
