// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Testing/Solver/EllipticTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// Known solutions on refined meshes: second order for u, first order for its gradient.

namespace smg::testing
{
namespace
{

struct Errors
{
  double value = 0.0, gradient = 0.0; ///< in L2, by the value at vertices and centroids
};

using Gradient = std::function<Eigen::Vector3d(const Point&)>;

/** The errors of a solve relative to a function and its gradient in the plane of the cell. */
Errors errorsOf(ElementProblem& problem, const ElementProblem::Field<double>& u, const Gradient& du)
{
  const StreamMesh& mesh = problem.mesh();
  MemorySource source(mesh);
  const std::unique_ptr<Solution> solution = solve(source, problem, accurate());
  EXPECT_TRUE(solution->report().converged);
  const DirectElements direct(problem);
  const Eigen::MatrixXd values = valuesOf(*solution);
  Errors errors;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    errors.value += direct.mass[v] * std::pow(values(v) - u(problem.vertex(v)), 2);
  }
  source.rewind(1000);
  ProblemResults results(source.info(), problem, *solution, { true, false });
  std::int64_t cell = 0;
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
    for (std::size_t c = 0; 3 * c < results.gradient().size(); ++c, ++cell)
    {
      const Eigen::Vector3d found = Eigen::Vector3d::Map(&results.gradient()[3 * c]);
      errors.gradient += (found - du(problem.centroid(cell))).squaredNorm();
    }
  }
  return { std::sqrt(errors.value / direct.mass.sum()),
    std::sqrt(errors.gradient / static_cast<double>(cell)) };
}

void expectOrders(const std::vector<Errors>& errors)
{
  for (std::size_t k = 1; k < errors.size(); ++k)
  {
    EXPECT_GT(std::log2(errors[k - 1].value / errors[k].value), 1.85);
    EXPECT_GT(std::log2(errors[k - 1].gradient / errors[k].gradient), 0.9);
  }
}

} // namespace

TEST(Manufactured, ScreenedHarmonicsOfASphere)
{
  // -Laplace z = 2 z on the unit sphere.
  std::vector<Errors> errors;
  for (const int subdivisions : { 2, 3, 4 })
  {
    const StreamMesh mesh = toStream(sphere(subdivisions));
    ElementProblem problem(mesh);
    problem.CellScreening = [](const Point&) { return 1.0; };
    problem.VertexSource = columnsOf(1, [](const Point& p, int) { return 3.0 * p[2]; });
    errors.push_back(errorsOf(
      problem, [](const Point& p) { return p[2]; },
      [](const Point& p) -> Eigen::Vector3d
      {
        const Eigen::Vector3d normal = p.normalized();
        return Eigen::Vector3d::UnitZ() - normal[2] * normal;
      }));
  }
  expectOrders(errors);
}

TEST(Manufactured, ABoxWithATensorAFluxAndHeatTransfer)
{
  // u = sin(pi x / 2) cos(y) e^z, K constant, on the unit cube: given at x = 0, heat transfer at
  // x = 1, fluxes elsewhere.
  const double a = std::numbers::pi / 2;
  Eigen::Matrix3d k;
  k << 2, 0.3, 0.1, 0.3, 1, -0.2, 0.1, -0.2, 1.5;
  const auto u = [=](const Point& p)
  { return std::sin(a * p[0]) * std::cos(p[1]) * std::exp(p[2]); };
  const auto du = [=](const Point& p) -> Eigen::Vector3d
  {
    const double e = std::exp(p[2]);
    return { a * std::cos(a * p[0]) * std::cos(p[1]) * e, -std::sin(a * p[0]) * std::sin(p[1]) * e,
      u(p) };
  };
  const auto source = [=](const Point& p)
  {
    const double e = std::exp(p[2]);
    const double s = std::sin(a * p[0]);
    const double c = std::cos(a * p[0]);
    Eigen::Matrix3d second;
    second << -a * a * s * std::cos(p[1]), -a * c * std::sin(p[1]), a * c * std::cos(p[1]),
      -a * c * std::sin(p[1]), -s * std::cos(p[1]), -s * std::sin(p[1]), a * c * std::cos(p[1]),
      -s * std::sin(p[1]), s * std::cos(p[1]);
    return -(k.cwiseProduct(second)).sum() * e;
  };
  std::vector<Errors> errors;
  for (const int n : { 4, 8, 16 })
  {
    IndexedTestMesh box = tetBox(n + 1, n + 1, n + 1);
    for (double& coordinate : box.positions)
    {
      coordinate /= n;
    }
    const StreamMesh mesh = toStream(box);
    ElementProblem problem(mesh);
    problem.Conductivity = [&](const Point&) { return k; };
    problem.VertexSource = columnsOf(1, [&](const Point& p, int) { return source(p); });
    problem.DirichletConditions.push_back(
      { below(0, 1e-9), columnsOf(1, [&](const Point& p, int) { return u(p); }) });
    const auto fluxOf = [&](const Eigen::Vector3d& normal)
    { return columnsOf(1, [&, normal](const Point& p, int) { return normal.dot(k * du(p)); }); };
    for (int axis = 1; axis < 3; ++axis)
    {
      const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
      problem.FluxConditions.push_back({ below(axis, 1e-9), fluxOf(-normal) });
      problem.FluxConditions.push_back({ above(axis, 1 - 1e-9), fluxOf(normal) });
    }
    // K du/dn = 2 (ambient - u) at x = 1.
    problem.RobinConditions.push_back({ above(0, 1 - 1e-9), [](const Point&) { return 2.0; },
      columnsOf(1, [&](const Point& p, int)
        { return u(p) + 0.5 * Eigen::Vector3d::UnitX().dot(k * du(p)); }) });
    errors.push_back(errorsOf(problem, u, du));
  }
  expectOrders(errors);
}

} // namespace smg::testing
