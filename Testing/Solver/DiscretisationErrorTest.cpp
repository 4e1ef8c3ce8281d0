// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/DiscretisationError.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "smg/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

// The estimated discretisation error against true ones, and solves that stop by it.

namespace smg::testing
{
namespace
{

using Gradient = std::function<Eigen::Vector3d(const Point&)>;

/** The integral of (grad u_h - grad u) . K (grad u_h - grad u), by quadrature of second order. */
double trueErrorSquare(ElementProblem& problem, Solution& solution, const Gradient& du)
{
  const StreamMesh& mesh = problem.mesh();
  MemorySource source(mesh);
  ProblemResults results(source.info(), problem, solution, { true, false });
  const int corners = cornersOf(mesh.cellType);
  const double most = corners == 3 ? 2.0 / 3.0 : 0.58541020;
  double sum = 0.0;
  std::int64_t cell = 0;
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
    for (std::size_t c = 0; 3 * c < results.gradient().size(); ++c, ++cell)
    {
      const Eigen::Vector3d found = Eigen::Vector3d::Map(&results.gradient()[3 * c]);
      const double* points[4] = {};
      for (int k = 0; k < corners; ++k)
      {
        points[k] = &mesh.positions[3 * mesh.corners[corners * cell + k]];
      }
      const Eigen::Matrix3d k = problem.Conductivity ? problem.Conductivity(problem.centroid(cell))
                                                     : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
      const double share = cellWeights(mesh.cellType, points).measure / corners;
      for (int q = 0; q < corners; ++q)
      {
        Point at = Point::Zero();
        for (int j = 0; j < corners; ++j)
        {
          at += (j == q ? most : (1.0 - most) / (corners - 1)) * Point::Map(points[j]);
        }
        const Eigen::Vector3d off = found - du(at);
        sum += share * off.dot(k * off);
      }
    }
  }
  return sum;
}

EnergySquares estimated(ElementProblem& problem, Solution& solution, std::int64_t blockCells = 1000)
{
  Pool pool(std::int64_t(1) << 30);
  MemorySource source(problem.mesh(), blockCells);
  DiscretisationError error(pool, source.info(), problem,
    [&](std::int64_t first, std::int64_t count, std::span<double> values)
    { solution.read(first, count, values); });
  for (MeshBlock block; source.next(block);)
  {
    error.add(block);
  }
  return error.finish();
}

std::unique_ptr<Solution> solved(ElementProblem& problem, const SolveOptions& options = accurate())
{
  MemorySource source(problem.mesh());
  return solve(source, problem, options);
}

/** The estimate of a problem with this solution is about its true error. */
void expectAboutTrue(ElementProblem& problem, const Gradient& du)
{
  const std::unique_ptr<Solution> solution = solved(problem);
  const double truth = std::sqrt(trueErrorSquare(problem, *solution, du));
  const double found = std::sqrt(estimated(problem, *solution).error);
  EXPECT_GT(found, 0.7 * truth);
  EXPECT_LT(found, 1.35 * truth);
}

/** The unit cube in (n - 1)^3 cubes of six tetrahedra each, whose inner vertices are moved. */
StreamMesh cube(int n, double jitter)
{
  IndexedTestMesh mesh = tetBox(n, n, n, jitter);
  for (std::size_t v = 0; 3 * v < mesh.positions.size(); ++v)
  {
    const auto size = static_cast<std::size_t>(n);
    const std::size_t place[] = { v % size, v / size % size, v / size / size };
    for (std::size_t d = 0; d < 3; ++d)
    {
      double& x = mesh.positions[3 * v + d];
      x = place[d] == 0 ? 0.0 : place[d] + 1 == size ? 1.0 : x / (n - 1);
    }
  }
  return toStream(shuffled(std::move(mesh)));
}

SolveOptions automatic(const StreamMesh& mesh)
{
  SolveOptions options;
  options.tolerance = SolveOptions::AutomaticTolerance;
  options.again = [&mesh] { return std::make_unique<MemorySource>(mesh, 700); };
  return options;
}

/** A source, in a cube of tetrahedra whose boundary is held at 0. */
ElementProblem heatedCube(const StreamMesh& mesh)
{
  ElementProblem problem(mesh);
  problem.VertexSource = columnsOf(1, [](const Point&, int) { return 1.0; });
  problem.DirichletConditions.push_back(
    { [](const Point& p) { return p.minCoeff() < 1e-9 || p.maxCoeff() > 1 - 1e-9; },
      columnsOf(1, [](const Point&, int) { return 0.0; }) });
  return problem;
}

} // namespace

TEST(DiscretisationError, OnATiltedPlaneOfAnyGrid)
{
  constexpr double Pi = std::numbers::pi;
  for (const double jitter : { 0.0, 0.3 })
  {
    for (const int n : { 20, 80 })
    {
      StreamMesh mesh = toStream(shuffled(grid(n, n, jitter)));
      for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
      {
        mesh.positions[v] /= n;
        mesh.positions[v + 1] /= n;
        mesh.positions[v + 2] = 0.75 * mesh.positions[v]; // along x, lengths are 1.25 x
      }
      const auto u = [](const Point& p, int) { return std::sin(Pi * p[0]) * std::sin(Pi * p[1]); };
      ElementProblem problem(mesh);
      problem.VertexSource =
        columnsOf(1, [u](const Point& p, int k) { return (1 / 1.5625 + 1) * Pi * Pi * u(p, k); });
      problem.DirichletConditions.push_back(
        { [](const Point& p) { return std::min(p[0], p[1]) < 0.1 || p[0] > 0.9 || p[1] > 0.75; },
          columnsOf(1, u) });
      expectAboutTrue(problem,
        [](const Point& p) -> Eigen::Vector3d
        {
          const double along = Pi * std::cos(Pi * p[0]) * std::sin(Pi * p[1]) / 1.5625;
          return { along, Pi * std::sin(Pi * p[0]) * std::cos(Pi * p[1]), 0.75 * along };
        });
    }
  }
}

TEST(DiscretisationError, OnASphere)
{
  const StreamMesh mesh = toStream(sphere(4));
  ElementProblem problem(mesh);
  problem.CellScreening = [](const Point&) { return 1.0; };
  problem.VertexSource = columnsOf(1, [](const Point& p, int) { return 7.0 * p[0] * p[2]; });
  expectAboutTrue(problem,
    [](const Point& p) -> Eigen::Vector3d
    {
      const Eigen::Vector3d n = p.normalized(), whole(n[2], 0.0, n[0]);
      return whole - n.dot(whole) * n;
    });
}

TEST(DiscretisationError, WithATensorFluxesAndHeatTransfer)
{
  // u = x^2 + x y + z^2.
  Eigen::Matrix3d k;
  k << 2, 0.3, 0.1, 0.3, 1, -0.2, 0.1, -0.2, 5;
  const auto u = [](const Point& p) { return p[0] * p[0] + p[0] * p[1] + p[2] * p[2]; };
  const auto du = [](const Point& p) -> Eigen::Vector3d {
    return { 2 * p[0] + p[1], p[0], 2 * p[2] };
  };
  for (const double jitter : { 0.0, 0.15 })
  {
    const StreamMesh mesh = cube(11, jitter);
    ElementProblem problem(mesh);
    problem.Conductivity = [&](const Point&) { return k; };
    problem.VertexSource = columnsOf(1, [](const Point&, int) { return -(4.0 + 0.6 + 10.0); });
    problem.DirichletConditions.push_back(
      { below(0, 1e-9), columnsOf(1, [&](const Point& p, int) { return u(p); }) });
    for (int axis = 1; axis < 3; ++axis)
    {
      for (const double side : { -1.0, 1.0 })
      {
        const Eigen::Vector3d normal = side * Eigen::Vector3d::Unit(axis);
        problem.FluxConditions.push_back({ side < 0 ? below(axis, 1e-9) : above(axis, 1 - 1e-9),
          columnsOf(1, [=](const Point& p, int) { return normal.dot(k * du(p)); }) });
      }
    }
    problem.RobinConditions.push_back({ above(0, 1 - 1e-9), [](const Point&) { return 2.0; },
      columnsOf(1, [=](const Point& p, int) { return u(p) + 0.5 * k.row(0).dot(du(p)); }) });
    expectAboutTrue(problem, du);
  }
}

/** Heat in the half of a cube that conducts well; the other half hardly does. */
TEST(DiscretisationError, BesideAPoorConductor)
{
  constexpr double Pi = std::numbers::pi;
  const double c = std::sqrt(2.0) * Pi;
  for (const double poor : { 1.0, 1e-2, 1e-4 })
  {
    // u = sin(pi y) sin(pi z) times this function of x, whose flux is continuous at 1/2.
    const double b = -poor * c / std::tanh(c / 2);
    const auto along = [=](double x)
    {
      return x < 0.5 ? std::cos(Pi * (x - 0.5)) + b * (x - 0.5) * 2 * x
                     : std::sinh(c * (1 - x)) / std::sinh(c / 2);
    };
    const auto slope = [=](double x)
    {
      return x < 0.5 ? -Pi * std::sin(Pi * (x - 0.5)) + b * (4 * x - 1)
                     : -c * std::cosh(c * (1 - x)) / std::sinh(c / 2);
    };
    const StreamMesh mesh = cube(17, 0.0);
    ElementProblem problem = heatedCube(mesh);
    problem.Conductivity = [=](const Point& p)
    { return Eigen::Matrix3d((p[0] < 0.5 ? 1.0 : poor) * Eigen::Matrix3d::Identity()); };
    problem.VertexSource = nullptr;
    problem.CellSource = columnsOf(1,
      [=](const Point& p, int)
      {
        const double second = -Pi * Pi * std::cos(Pi * (p[0] - 0.5)) + 4 * b;
        return p[0] > 0.5
                 ? 0.0
                 : (2 * Pi * Pi * along(p[0]) - second) * std::sin(Pi * p[1]) * std::sin(Pi * p[2]);
      });
    expectAboutTrue(problem,
      [=](const Point& p) -> Eigen::Vector3d
      {
        const double y = std::sin(Pi * p[1]), z = std::sin(Pi * p[2]);
        return { slope(p[0]) * y * z, Pi * along(p[0]) * std::cos(Pi * p[1]) * z,
          Pi * along(p[0]) * y * std::cos(Pi * p[2]) };
      });
  }
}

/** Where the flux is that of the problem everywhere, nothing is off. */
TEST(DiscretisationError, IsNothingForLinearSolutions)
{
  const StreamMesh mesh = block();
  ElementProblem problem(mesh);
  const Eigen::Vector3d slope(1.0, -2.0, 0.5);
  problem.CellField = [](const Point&) -> Eigen::MatrixXd
  { return Eigen::Vector3d(0.1, 0.2, 0.3); };
  problem.DirichletConditions.push_back({ [](const Point&) { return true; },
    columnsOf(1, [=](const Point& p, int) { return slope.dot(p); }) });
  const EnergySquares squares = estimated(problem, *solved(problem));
  EXPECT_LT(squares.error, 1e-20 * squares.solution);
  EXPECT_GT(squares.solution, 0.0);
}

TEST(DiscretisationError, DoesNotDependOnBlocks)
{
  for (const StreamMesh& mesh : { patch(), block() })
  {
    ElementProblem problem(mesh);
    problem.Columns = 2;
    problem.Conductivity = someTensor;
    problem.DirichletConditions.push_back(
      { below(0, 1.0), columnsOf(2, [](const Point& p, int k) { return p[1] * (k + 1); }) });
    problem.FluxConditions.push_back(
      { above(1, 3.0), columnsOf(2, [](const Point& p, int k) { return p[0] - k; }) });
    const std::unique_ptr<Solution> solution = solved(problem);
    const EnergySquares all = estimated(problem, *solution, 1 << 20);
    for (const std::int64_t cells : { 1, 7, 100 })
    {
      const EnergySquares parts = estimated(problem, *solution, cells);
      EXPECT_EQ(parts.error, all.error);
      EXPECT_EQ(parts.solution, all.solution);
    }
  }
}

/** It stops early, and the algebraic error is what it says: below a tenth, in the energy norm. */
TEST(AutomaticTolerance, StopsBelowATenthOfTheDiscretisationError)
{
  for (const double offset : { 0.0, 1e6 })
  {
    const StreamMesh mesh = cube(25, 0.2);
    ElementProblem problem = heatedCube(mesh);
    problem.DirichletConditions.front().value =
      columnsOf(1, [=](const Point&, int) { return offset; });
    problem.Initial = problem.DirichletConditions.front().value;
    const std::unique_ptr<Solution> exact = solved(problem, accurate());
    problem.Initial = nullptr;
    const std::unique_ptr<Solution> found = solved(problem, automatic(mesh));
    const Report& report = found->report();
    ASSERT_TRUE(report.errors);
    EXPECT_TRUE(report.converged);
    if (offset == 0.0) // else the initial values are so far off that 1e-6 of them is too much
    {
      EXPECT_LT(report.cycles, solved(problem, accurate(1e-6))->report().cycles);
    }
    // The energy of the difference, by the same sums.
    Pool pool(std::int64_t(1) << 30);
    MemorySource source(mesh);
    DiscretisationError difference(pool, source.info(), problem,
      [&](std::int64_t first, std::int64_t count, std::span<double> values)
      {
        std::vector<double> other(values.size());
        exact->read(first, count, other);
        found->read(first, count, values);
        std::ranges::transform(values, other, values.begin(), std::minus());
      });
    for (MeshBlock block; source.next(block);)
    {
      difference.add(block);
    }
    const double truth = std::sqrt(difference.finish().solution);
    EXPECT_LE(report.errors->algebraic, 0.1 * report.errors->discretisation);
    EXPECT_LT(truth, 0.12 * report.errors->discretisation);
    EXPECT_GT(report.errors->algebraic, 0.5 * truth);
    EXPECT_LT(report.errors->algebraic, 8.0 * truth);
    EXPECT_NEAR(report.errors->discretisation, std::sqrt(estimated(problem, *exact).error),
      0.05 * report.errors->discretisation);
  }
}

TEST(AutomaticTolerance, GivesTheSameBitsInAnyWay)
{
  const StreamMesh mesh = cube(17, 0.2);
  ElementProblem problem = heatedCube(mesh);
  SolveOptions options = automatic(mesh);
  options.inCore = true;
  const std::unique_ptr<Solution> inCore = solved(problem, options);
  for (const int threads : { 1, 3 })
  {
    options = automatic(mesh);
    options.threads = threads;
    options.blockNodes = threads == 1 ? 4096 : 100;
    options.coreNodes = 100;
    const std::unique_ptr<Solution> streamed = solved(problem, options);
    EXPECT_EQ(valuesOf(*streamed), valuesOf(*inCore));
    EXPECT_EQ(streamed->report().cycles, inCore->report().cycles);
    EXPECT_EQ(streamed->report().errors->algebraic, inCore->report().errors->algebraic);
    EXPECT_EQ(streamed->report().errors->discretisation, inCore->report().errors->discretisation);
  }
}

TEST(AutomaticTolerance, EndsAtASmallResidualWhereFiniteElementsAreExact)
{
  const StreamMesh mesh = patch(40, 30);
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back(
    { below(0, 1e-9), columnsOf(1, [](const Point&, int) { return 3.0; }) });
  problem.Initial = columnsOf(1, [](const Point& p, int) { return p[0]; });
  const Report report = solved(problem, automatic(mesh))->report();
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual(), 1e-9); // of a ten-thousandth of the right-hand side
  // Both are nothing but rounding, and there is no energy to compare them with.
  ASSERT_TRUE(report.errors);
  EXPECT_LT(report.errors->algebraic, 1e-5);
  EXPECT_LT(report.errors->discretisation, 1e-5);
  EXPECT_TRUE(hasNote(report, "estimated errors"));
}

TEST(AutomaticTolerance, IsRefusedWhereItHasNoMeaning)
{
  const StreamMesh mesh = patch();
  ElementProblem problem = heatedCube(mesh);
  SolveOptions options = automatic(mesh);
  problem.EdgeWeights = Weights::Uniform;
  EXPECT_NE(messageOf([&] { solved(problem, options); }).find("uniform weights have no"),
    std::string::npos);
  problem.EdgeWeights = Weights::Cotangent;
  DeformOptions deformation;
  deformation.tolerance = SolveOptions::AutomaticTolerance;
  EXPECT_NE(
    messageOf([&] { checkOptions(deformation); }).find("a deformation has no automatic tolerance"),
    std::string::npos);
  options.again = nullptr;
  EXPECT_NE(
    messageOf([&] { solved(problem, options); }).find("SolveOptions::again"), std::string::npos);
}

} // namespace smg::testing
