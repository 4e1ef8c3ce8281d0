// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"
#include "smg/DescribedProblem.h"
#include "smg/SolvedMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;

/** A mesh with a core, a shell, and a group in both; some cells are in none. */
MemoryMesh grouped(CellType type, std::int64_t blockCells = 1000)
{
  StreamMesh mesh = toStream(type == CellType::Triangle ? grid(9, 8, 0.3) : tetBox(5, 4, 4, 0.2));
  mesh.groups.groups = { { "core", 7, GroupOf::Cells }, { "shell", {}, GroupOf::Cells },
    { "probe", {}, GroupOf::Cells }, { "edge", {}, GroupOf::Facets },
    { "far", {}, GroupOf::Cells } };
  mesh.groups.sets = { {}, { 0 }, { 1 }, { 0, 2 }, { 1, 2 } };
  std::vector<GroupSet> sets;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    sets.push_back(static_cast<GroupSet>(c * 7 % 11 % 5));
  }
  mesh.cellColumns.push_back(makeColumn<GroupSet>(CellGroupsName, sets));
  return MemoryMesh(mesh, blockCells);
}

ProblemDescription heatOfGroups()
{
  ProblemDescription heat;
  heat.columns = 2;
  heat.conductivity = { { Everywhere{}, 2.0 }, { InGroup{ { "core" } }, { 1.0, 3.0, 2.0 } } };
  heat.dirichlet = { { Region::HalfSpace{ { 1, 0, 0 }, 2.5 }, { 1.0, -2.0 } } };
  heat.robin = { { OnBoundary{}, 0.5, { 4.0, 3.0 } } };
  heat.source = { { InGroup{ { "shell" } }, { 1.0, 2.0 } } };
  heat.integrals = { "probe", "*", "7" };
  return heat;
}

struct WithResults
{
  StreamMesh mesh;
  Report report;
};

WithResults resultsOn(const MemoryMesh& mesh, const ProblemDescription& description, int threads)
{
  DescribedProblem problem(description, mesh.info());
  const auto source = [&] { return mesh.source(problem.vertexColumns(), problem.cellColumns()); };
  problem.prepare(*source());
  SolveOptions options;
  options.tolerance = 1e-12;
  const auto solution = solve(*source(), problem, options);
  ResultOptions results{ .gradient = true, .flux = true };
  results.gradientAtVertices = true;
  results.integrals = description.integrals;
  results.threads = threads;
  SolvedMesh solved(mesh, problem, *solution, results);
  WithResults found{ collect(solved), solution->report() };
  solved.finish(found.report);
  return found;
}

const Column& columnOf(const std::vector<Column>& columns, const std::string& name)
{
  return *std::ranges::find_if(
    columns, [&](const Column& column) { return column.spec.name == name; });
}

MatrixXd rowsOf(const Column& column, std::int64_t rows)
{
  MatrixXd values(rows, column.spec.components);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    for (int k = 0; k < values.cols(); ++k)
    {
      values(r, k) = column.value(r, k);
    }
  }
  return values;
}

double measureOf(const StreamMesh& mesh, std::int64_t c)
{
  const int size = cornersOf(mesh.cellType);
  const auto edge = [&](int k) -> Vector3d
  {
    return Vector3d::Map(&mesh.positions[3 * mesh.corners[size * c + k]]) -
           Vector3d::Map(&mesh.positions[3 * mesh.corners[size * c]]);
  };
  return size == 3 ? edge(1).cross(edge(2)).norm() / 2
                   : std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6;
}

void expectNear(const std::vector<double>& found, const Eigen::RowVectorXd& expected)
{
  ASSERT_EQ(std::ssize(found), expected.size());
  for (Eigen::Index k = 0; k < expected.size(); ++k)
  {
    EXPECT_NEAR(found[static_cast<std::size_t>(k)], expected[k], 1e-11 * (1.0 + expected.norm()));
  }
}

} // namespace

class Integrals : public ::testing::TestWithParam<CellType>
{
};

/** Of what the result has in its vertices and cells. */
TEST_P(Integrals, AreSumsOverTheCellsOfGroups)
{
  const MemoryMesh mesh = grouped(this->GetParam());
  const WithResults found = resultsOn(mesh, heatOfGroups(), 1);
  const int size = cornersOf(this->GetParam());
  const MatrixXd u = rowsOf(columnOf(found.mesh.vertexColumns, "Solution"), found.mesh.vertices());
  const MatrixXd gradient =
    rowsOf(columnOf(found.mesh.cellColumns, "Gradient"), found.mesh.cells());
  const MatrixXd flux = rowsOf(columnOf(found.mesh.cellColumns, "Flux"), found.mesh.cells());
  const MatrixXd sets =
    rowsOf(columnOf(found.mesh.cellColumns, CellGroupsName), found.mesh.cells());
  const std::vector<std::string> names{ "all", "probe", "core", "shell", "far" };
  ASSERT_EQ(found.report.integrals.size(), names.size());
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    const Report::Integral& part = found.report.integrals[n];
    EXPECT_EQ(part.name, names[n]);
    const std::uint32_t group = n == 1 ? 2 : n == 2 ? 0 : n == 3 ? 1 : 4;
    double measure = 0.0;
    Eigen::RowVectorXd value = Eigen::RowVectorXd::Zero(2), slopes = Eigen::RowVectorXd::Zero(6),
                       flows = slopes;
    for (std::int64_t c = 0; c < found.mesh.cells(); ++c)
    {
      const auto& set = found.mesh.groups.sets[static_cast<std::size_t>(sets(c, 0))];
      if (n > 0 && std::ranges::find(set, group) == set.end())
      {
        continue;
      }
      const double own = measureOf(found.mesh, c);
      measure += own;
      for (int k = 0; k < size; ++k)
      {
        value += own / size * u.row(found.mesh.corners[size * c + k]);
      }
      slopes += own * gradient.row(c);
      flows += own * flux.row(c);
    }
    expectNear({ part.measure }, Eigen::RowVectorXd::Constant(1, measure));
    expectNear(part.integral, value);
    expectNear(part.gradient, slopes);
    expectNear(part.flux, flows);
    if (measure > 0.0)
    {
      expectNear(part.mean, value / measure);
    }
    else
    {
      EXPECT_TRUE(std::isnan(part.mean[0]));
      EXPECT_TRUE(std::ranges::any_of(found.report.warnings, [](const std::string& warning)
        { return warning.find("the group far has no") != std::string::npos; }));
    }
  }
}

TEST_P(Integrals, HaveTheSameBitsForAnyBlocksAndThreads)
{
  const WithResults expected = resultsOn(grouped(this->GetParam()), heatOfGroups(), 1);
  for (const std::int64_t blockCells : { 1, 7, 100 })
  {
    const WithResults found = resultsOn(grouped(this->GetParam(), blockCells), heatOfGroups(), 2);
    for (std::size_t n = 0; n < expected.report.integrals.size(); ++n)
    {
      const Report::Integral &a = found.report.integrals[n], &b = expected.report.integrals[n];
      EXPECT_EQ(a.measure, b.measure);
      EXPECT_EQ(a.integral, b.integral);
      EXPECT_EQ(a.gradient, b.gradient);
      EXPECT_EQ(a.flux, b.flux);
    }
    EXPECT_EQ(columnOf(found.mesh.vertexColumns, "Gradient").bytes,
      columnOf(expected.mesh.vertexColumns, "Gradient").bytes);
  }
}

TEST_P(Integrals, OfALinearSolutionAreExact)
{
  const MemoryMesh mesh = grouped(this->GetParam());
  ProblemDescription linear;
  linear.columns = 3;
  linear.conductivity = 2.0;
  linear.dirichlet = { { OnBoundary{}, Position{} } };
  linear.integrals = { "*" };
  const WithResults found = resultsOn(mesh, linear, 1);
  for (const Report::Integral& part : found.report.integrals)
  {
    for (std::size_t k = 0; k < 9; ++k)
    {
      // The grid is in the plane z = 0 only without its waves: see the tetrahedra.
      if (this->GetParam() == CellType::Tetrahedron)
      {
        EXPECT_NEAR(part.gradient[k], k % 4 == 0 ? part.measure : 0.0, 1e-7);
      }
      EXPECT_NEAR(part.flux[k], -2.0 * part.gradient[k], 1e-12);
    }
  }
  if (this->GetParam() == CellType::Tetrahedron)
  {
    const MatrixXd gradient =
      rowsOf(columnOf(found.mesh.vertexColumns, "Gradient"), found.mesh.vertices());
    const Eigen::RowVectorXd identity =
      Eigen::RowVectorXd::Map(Eigen::Matrix3d::Identity().eval().data(), 9);
    EXPECT_LT((gradient.rowwise() - identity).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST_P(Integrals, GradientsAtVerticesAreWeightedMeansOfTheirCells)
{
  const MemoryMesh mesh = grouped(this->GetParam());
  const WithResults found = resultsOn(mesh, heatOfGroups(), 1);
  const MatrixXd cells = rowsOf(columnOf(found.mesh.cellColumns, "Gradient"), found.mesh.cells());
  const MatrixXd vertices =
    rowsOf(columnOf(found.mesh.vertexColumns, "Gradient"), found.mesh.vertices());
  MatrixXd sums = MatrixXd::Zero(vertices.rows(), vertices.cols());
  Eigen::VectorXd measures = Eigen::VectorXd::Zero(vertices.rows());
  const int size = cornersOf(this->GetParam());
  for (std::int64_t c = 0; c < found.mesh.cells(); ++c)
  {
    for (int k = 0; k < size; ++k)
    {
      const std::int64_t v = found.mesh.corners[size * c + k];
      sums.row(v) += measureOf(found.mesh, c) * cells.row(c);
      measures[v] += measureOf(found.mesh, c);
    }
  }
  EXPECT_LT((vertices - measures.cwiseInverse().asDiagonal() * sums).cwiseAbs().maxCoeff(), 1e-11);
}

TEST_P(Integrals, OfWhatIsNoGroupOfCellsAreRefused)
{
  const MemoryMesh mesh = grouped(this->GetParam());
  const auto errorOf = [&](const char* name)
  {
    ProblemDescription problem;
    problem.integrals = { "core", name };
    return messageOf([&] { DescribedProblem(problem, mesh.info(), "p.json"); });
  };
  EXPECT_EQ(errorOf("edge"),
    "p.json: integrals[1]: the group 'edge' is of facets, but cells are needed here.");
  EXPECT_EQ(errorOf("cores"), "p.json: integrals[1]: the mesh has no group 'cores'; it has 'core', "
                              "'edge', 'far', 'probe' and 'shell'.");
}

INSTANTIATE_TEST_SUITE_P(OfCells, Integrals,
  ::testing::Values(CellType::Triangle, CellType::Tetrahedron),
  [](const auto& info) { return info.param == CellType::Triangle ? "Triangles" : "Tetrahedra"; });

} // namespace smg::testing
