// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/ErrorMessage.h"
#include "smg/DescribedProblem.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

// Vertices that are one unknown, or linked, against the system of the mesh without couplings,
// reduced by hand: with u = T v + g, T' (A + C) T v = T' (b - (A + C) g), where C has the links.
// The solver rounds weights to single precision.

namespace smg::testing
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/** A problem with couplings that are given by hand. */
class CoupledProblem : public ElementProblem
{
public:
  using ElementProblem::ElementProblem;
  std::shared_ptr<VertexCouplings> Couplings = std::make_shared<VertexCouplings>();
  std::shared_ptr<const VertexCouplings> couplings() const override { return this->Couplings; }
};

/** The vertices of a mesh by their places on a lattice, of which there may be several at one. */
std::map<std::array<long, 3>, std::vector<std::int64_t>> byPlace(const StreamMesh& mesh)
{
  std::map<std::array<long, 3>, std::vector<std::int64_t>> places;
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    places[{ std::lround(p[0]), std::lround(p[1]), std::lround(p[2]) }].push_back(v);
  }
  return places;
}

/** A box of tetrahedra with jittered vertices, but flat sides, of which opposite ones are copies of
 * each other. */
IndexedTestMesh periodicBox(int nx, int ny, int nz, std::uint64_t seed = 1)
{
  IndexedTestMesh mesh = shuffled(tetBox(nx, ny, nz, 0.15, seed), seed);
  for (std::size_t k = 0; k < mesh.positions.size(); k += 3)
  {
    double* p = &mesh.positions[k];
    const double x = std::round(p[0]), y = std::round(p[1]), z = std::round(p[2]);
    if (x == 0 || x == nx - 1 || y == 0 || y == ny - 1 || z == 0 || z == nz - 1)
    {
      std::transform(p, p + 3, p, [](double c) { return std::round(c); });
    }
  }
  return mesh;
}

/** Ties the vertices at x = width to those at x = 0, and those at y = depth to y = 0, with the
 * jumps of one column after the other. */
void tieSides(const StreamMesh& mesh, VertexCouplings& couplings, long width, long depth,
  const std::vector<double>& alongX, const std::vector<double>& alongY)
{
  const auto places = byPlace(mesh);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    const double* p = &mesh.positions[3 * v];
    const std::array<long, 3> at{ std::lround(p[0]), std::lround(p[1]), std::lround(p[2]) };
    std::vector<std::pair<std::int64_t, std::array<long, 3>>> copies;
    for (const long x : { at[0] % width == 0 ? 0L : at[0], at[0] % width == 0 ? width : at[0] })
    {
      for (const long y : { at[1] % depth == 0 ? 0L : at[1], at[1] % depth == 0 ? depth : at[1] })
      {
        copies.emplace_back(places.at({ x, y, at[2] }).front(), std::array{ x, y, at[2] });
      }
    }
    const auto node = *std::ranges::min_element(copies);
    if (node.first != v)
    {
      couplings.ties.push_back({ v, node.first });
      for (std::size_t k = 0; k < alongX.size(); ++k)
      {
        couplings.jumps.push_back(
          alongX[k] * static_cast<double>((at[0] - node.second[0]) / width) +
          alongY[k] * static_cast<double>((at[1] - node.second[1]) / depth));
      }
    }
  }
}

/** The solution of the reduced system. */
MatrixXd reducedSolution(const CoupledProblem& problem)
{
  const DirectElements direct(problem);
  const StreamMesh& mesh = problem.mesh();
  const int n = static_cast<int>(mesh.vertices()), columns = problem.Columns;
  std::vector<int> node(static_cast<std::size_t>(n));
  MatrixXd g = MatrixXd::Zero(n, columns);
  for (int v = 0; v < n; ++v)
  {
    node[static_cast<std::size_t>(v)] = v;
  }
  const VertexCouplings& couplings = *problem.Couplings;
  for (std::size_t t = 0; t < couplings.ties.size(); ++t)
  {
    const auto v = static_cast<int>(couplings.ties[t].vertex);
    node[static_cast<std::size_t>(v)] = static_cast<int>(couplings.ties[t].to);
    for (int k = 0; k < columns && !couplings.jumps.empty(); ++k)
    {
      g(v, k) =
        couplings.jumps[t * static_cast<std::size_t>(columns) + static_cast<std::size_t>(k)];
    }
  }
  std::vector<Eigen::Triplet<double>> links;
  for (const VertexCouplings::Link& link : couplings.links)
  {
    const auto a = static_cast<int>(link.from), b = static_cast<int>(link.to);
    links.emplace_back(a, a, link.conductance);
    links.emplace_back(b, b, link.conductance);
    links.emplace_back(a, b, -link.conductance);
    links.emplace_back(b, a, -link.conductance);
  }
  Sparse coupled(n, n);
  coupled.setFromTriplets(links.begin(), links.end());
  const Sparse all = direct.matrix + coupled;
  // Unknowns are the nodes without a prescribed value.
  MatrixXd known = g;
  std::vector<int> number(static_cast<std::size_t>(n), -1);
  std::vector<Eigen::Triplet<double>> entries;
  int unknowns = 0;
  for (int v = 0; v < n; ++v)
  {
    const int condition = problem.dirichletOf(v);
    if (condition >= 0)
    {
      known.row(v) = problem.DirichletConditions[static_cast<std::size_t>(condition)]
                       .value(problem.vertex(v))
                       .transpose();
      continue;
    }
    const auto of = static_cast<std::size_t>(node[static_cast<std::size_t>(v)]);
    number[of] = number[of] < 0 ? unknowns++ : number[of];
    entries.emplace_back(v, number[of], 1.0);
  }
  Sparse T(n, unknowns);
  T.setFromTriplets(entries.begin(), entries.end());
  const Sparse reduced = T.transpose() * all * T;
  const Eigen::SimplicialLDLT<Sparse> solver(reduced);
  const MatrixXd right = T.transpose() * (direct.rightSide - all * known);
  return T * solver.solve(right) + known;
}

/** The report of a solve with its results. */
Report resultsOf(const StreamMesh& mesh, Problem& problem)
{
  MemorySource source(mesh, 37);
  const std::unique_ptr<Solution> solution = solve(source, problem, accurate(1e-12));
  Report report = solution->report();
  source.rewind(37);
  ProblemResults results(source.info(), problem, *solution, {});
  for (MeshBlock block; source.next(block);)
  {
    results.add(block);
  }
  results.finish(report);
  return report;
}

/** What flows into the body through each condition, by column. */
void expectBalance(const Report& report, int columns)
{
  for (int k = 0; k < columns; ++k)
  {
    double sum = 0.0, most = 0.0;
    for (const Report::Condition& condition : report.conditions)
    {
      sum += condition.flux[static_cast<std::size_t>(k)];
      most = std::max(most, std::fabs(condition.flux[static_cast<std::size_t>(k)]));
    }
    EXPECT_NEAR(sum, 0.0, 1e-9 * most);
    EXPECT_GT(most, 0.1);
  }
}

/** Random data at vertices, in cells and on facets, with two columns. */
void setData(CoupledProblem& problem, double height)
{
  problem.Columns = 2;
  problem.Conductivity = someTensor;
  problem.VertexScreening = [](const Point& p) { return 0.1 + 0.05 * std::cos(p[2]); };
  problem.CellScreening = [](const Point& p) { return 0.02 * p[1]; };
  problem.VertexSource = columnsOf(2, [](const Point& p, int k) { return std::sin(p[2] + k); });
  problem.CellSource = columnsOf(2, [](const Point& p, int k) { return 0.3 * p[0] - k; });
  problem.RobinConditions = { { below(2, 0.5), [](const Point& p) { return 1 + 0.1 * p[0]; },
    columnsOf(2, [](const Point& p, int k) { return p[1] + k; }) } };
  problem.FluxConditions = { { above(2, height - 0.5),
    columnsOf(2, [](const Point& p, int k) { return 0.2 * p[0] - 0.5 * k; }) } };
}

} // namespace

TEST(Couplings, TiedSidesAgreeWithTheReducedSystem)
{
  for (const std::vector<double>& jump : { std::vector{ 0.0, 0.0 }, std::vector{ 1.0, -2.0 } })
  {
    const StreamMesh mesh = toStream(periodicBox(7, 6, 5));
    CoupledProblem problem(mesh);
    setData(problem, 4);
    tieSides(mesh, *problem.Couplings, 6, 5, jump, { 0.0, jump[0] });
    const MatrixXd expected = reducedSolution(problem);
    const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
    EXPECT_TRUE(solved.report.converged);
    EXPECT_EQ(solved.report.passes, solved.report.cycles + 1);
    EXPECT_LT(relativeError(solved.values, expected), 1e-8);
    // Blocks, threads and memory change nothing.
    for (const std::int64_t block : { 1, 37 })
    {
      SolveOptions options = accurate(1e-12);
      options.inCore = block == 37;
      options.threads = block == 1 ? 1 : 4;
      options.blockNodes = 64;
      EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options, block).values, solved.values))
        << block;
    }
  }
}

/** Of a problem with prescribed values on tied vertices, too. */
TEST(Couplings, PrescribedSidesAgree)
{
  const StreamMesh mesh = toStream(periodicBox(6, 6, 6));
  CoupledProblem problem(mesh);
  problem.Conductivity = someTensor;
  tieSides(mesh, *problem.Couplings, 5, 5, { 0.5 }, { 0.0 });
  problem.DirichletConditions = {
    { below(2, 0.4), columnsOf(1, [](const Point& p, int) { return 0.1 * p[0] + 3.0; }) },
    { above(2, 4.6), columnsOf(1, [](const Point& p, int) { return 0.1 * p[0]; }) }
  };
  const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
  EXPECT_LT(relativeError(solved.values, reducedSolution(problem)), 1e-8);
  expectBalance(resultsOf(mesh, problem), 1);

  problem.DirichletConditions[0].value =
    columnsOf(1, [](const Point& p, int) { return 0.2 * p[0]; });
  expectError([&] { solveMesh(mesh, problem); }, "state the condition on both sides");
}

/** Two bodies with a copy each of the vertices between them, of the same or another conductivity.
 */
TEST(Couplings, LinksAgreeWithTheDirectSystem)
{
  const IndexedTestMesh left = periodicBox(4, 5, 5), right = periodicBox(5, 5, 5, 2);
  const StreamMesh mesh = toStream(disjointUnion(left, right, { 3, 0, 0 }));
  for (const double conductance : { 1e-6, 0.7, 1e6 })
  {
    CoupledProblem problem(mesh);
    setData(problem, 4);
    problem.Conductivity = [](const Point& p) -> Eigen::Matrix3d
    { return (p[0] < 3 ? 1.0 : 5.0) * Eigen::Matrix3d::Identity(); };
    for (const auto& [place, vertices] : byPlace(mesh))
    {
      if (vertices.size() == 2)
      {
        problem.Couplings->links.push_back(
          { std::min(vertices[0], vertices[1]), std::max(vertices[0], vertices[1]), conductance });
      }
    }
    ASSERT_EQ(problem.Couplings->links.size(), 25U);
    std::ranges::sort(problem.Couplings->links, {}, &VertexCouplings::Link::from);
    const MatrixXd expected = reducedSolution(problem);
    const Solved solved = solveMesh(mesh, problem, accurate(1e-12));
    EXPECT_LT(relativeError(solved.values, expected), 1e-8) << conductance;
    EXPECT_EQ(solved.report.components, 1);
    SolveOptions options = accurate(1e-12);
    options.threads = 4;
    options.blockNodes = 64;
    EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options, 1).values, solved.values));
  }
}

/** A layer of two materials with a contact between them, and a periodic one with a jump: the
 * solutions are linear, which finite elements have exactly. */
TEST(Couplings, DescriptionsHaveAnalyticSolutions)
{
  const StreamMesh mesh =
    toStream(disjointUnion(periodicBox(4, 5, 5), periodicBox(5, 5, 5, 2), { 3, 0, 0 }));
  ProblemDescription contact;
  contact.conductivity = { { Everywhere{}, 2.0 }, { Region::HalfSpace{ { 1, 0, 0 }, 3.0 }, 5.0 } };
  contact.dirichlet = { { Region::HalfSpace{ { -1, 0, 0 }, 0.0 }, 0.0 },
    { Region::HalfSpace{ { 1, 0, 0 }, 7.0 }, 1.0 } };
  contact.interfaces = { { Region::Box{ { 3, 0, 0 }, { 3, 4, 4 } }, 0.5 } };
  DescribedProblem problem(contact, MemorySource(mesh).info());
  MemorySource source(mesh, 37);
  problem.prepare(source);
  const Report report = resultsOf(mesh, problem);
  const double flow = 16.0 / (3.0 / 2.0 + 1.0 / 0.5 + 4.0 / 5.0);
  ASSERT_EQ(report.conditions.size(), 2U);
  EXPECT_NEAR(report.conditions[1].flux[0], flow, 1e-8 * flow);
  EXPECT_NEAR(report.conditions[0].flux[0], -flow, 1e-8 * flow);
  ASSERT_EQ(report.contacts.size(), 1U);
  EXPECT_EQ(report.contacts[0].name, "interface[0]");
  EXPECT_NEAR(report.contacts[0].area, 16.0, 1e-12);
  EXPECT_NEAR(report.contacts[0].flow[0], flow, 1e-8 * flow);
  EXPECT_NEAR(report.contacts[0].step[0], flow / 16.0 / 0.5, 1e-8);

  const StreamMesh box = toStream(periodicBox(6, 5, 5));
  ProblemDescription periodic;
  const auto side = [](double x, double y, double z, double at) -> Where {
    return Region::HalfSpace{ { x, y, z }, at };
  };
  periodic.periodic = { { side(-1, 0, 0, 0), side(1, 0, 0, 5), { 1.0 } },
    { side(0, -1, 0, 0), side(0, 1, 0, 4) } };
  DescribedProblem ofBox(periodic, MemorySource(box).info());
  MemorySource again(box, 37);
  ofBox.prepare(again);
  const MatrixXd values = solveMesh(box, ofBox, accurate(1e-12)).values;
  const double start = -0.5; // since the mean stays 0
  for (std::int64_t v = 0; v < box.vertices(); ++v)
  {
    EXPECT_NEAR(values(v, 0) - box.positions[3 * v] / 5, start, 1e-8);
  }
}

/** Layers conduct as resistors in a row across them, and side by side along them. */
TEST(Couplings, ACellOfLayersHasTheMeansOfItsConductivities)
{
  IndexedTestMesh shape = periodicBox(7, 5, 5);
  for (std::size_t k = 0; k < shape.positions.size(); k += 3)
  {
    double& x = shape.positions[k];
    x = std::round(x) == 4 ? 4.0 : x; // where the layers meet
  }
  const StreamMesh box = toStream(shape);
  const auto side = [](double x, double y, double z, double at) -> Where {
    return Region::HalfSpace{ { x, y, z }, at };
  };
  for (const bool across : { true, false })
  {
    // A layer of 20 from x = 4 to 6, of which a third of the cell is.
    ProblemDescription layers;
    layers.conductivity = { { Everywhere{}, 1.0 }, { side(1, 0, 0, 4), 20.0 } };
    layers.periodic = { { side(-1, 0, 0, 0), side(1, 0, 0, 6), { across ? 6.0 : 0.0 } },
      { side(0, -1, 0, 0), side(0, 1, 0, 4), { across ? 0.0 : 4.0 } },
      { side(0, 0, -1, 0), side(0, 0, 1, 4) } };
    DescribedProblem problem(layers, MemorySource(box).info());
    MemorySource source(box, 37);
    problem.prepare(source);
    const Report report = resultsOf(box, problem);
    const double expected =
      across ? 1.0 / (2.0 / 3.0 / 1.0 + 1.0 / 3.0 / 20.0) : 2.0 / 3.0 + 20.0 / 3.0;
    ASSERT_EQ(report.parts.front().name, "all");
    EXPECT_NEAR(report.parts.front().gradient[across ? 0 : 1], 1.0, 1e-8);
    EXPECT_NEAR(-report.parts.front().flux[across ? 0 : 1], expected, 1e-7 * expected);
  }
}

TEST(Couplings, SidesThatDoNotMatchAreErrorsThatNameThePlace)
{
  const StreamMesh mesh = toStream(shuffled(tetBox(5, 5, 5, 0.1)));
  ProblemDescription description;
  description.periodic = { { Region::HalfSpace{ { -1, 0, 0 }, -0.3 },
    Region::HalfSpace{ { 1, 0, 0 }, 3.7 } } };
  const auto prepare = [&]
  {
    DescribedProblem problem(description, MemorySource(mesh).info(), "p.json");
    MemorySource source(mesh);
    problem.prepare(source);
  };
  expectError(prepare, "p.json: periodic[0]: ");
  expectError(prepare, "have no copy among those of the second side; the first is at (");
  description.periodic = {};
  description.interfaces = { { Region::Box{ { 1.5, -1, -1 }, { 2.5, 9, 9 } }, 1.0 } };
  expectError(prepare, "p.json: interface[0]: ");
  expectError(prepare, "no copy of another body at their place");
  description.interfaces = {};
  description.periodic = { { OnBoundary{}, Region::HalfSpace{ { 1, 0, 0 }, 3.7 } } };
  expectError(prepare, "periodic[0]: needs facets: a group, a region or a column");
}

} // namespace smg::testing
