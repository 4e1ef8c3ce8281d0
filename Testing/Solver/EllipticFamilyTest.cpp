// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/EllipticTesting.h"
#include "Testing/Support/Combinations.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <bit>
#include <functional>

// Compares each datum of a problem with an independently assembled system.

namespace smg::testing
{
namespace
{

constexpr int Columns = 2;

double wave(const Point& p, int k)
{
  return std::sin(0.7 * p[0] + k) + 0.3 * std::cos(p[1] - 0.5 * p[2]);
}

struct Datum
{
  std::string name;
  std::function<void(ElementProblem&)> set;
};

/** Prescribes one end; the other data vary. */
void holdOneEnd(ElementProblem& problem)
{
  problem.DirichletConditions.push_back({ below(0, 0.6), columnsOf(Columns, wave) });
}

std::vector<Datum> data()
{
  return {
    { "source at vertices", [](ElementProblem& p) { p.VertexSource = columnsOf(Columns, wave); } },
    { "source in cells", [](ElementProblem& p) { p.CellSource = columnsOf(Columns, wave); } },
    { "screening at vertices",
      [](ElementProblem& p) { p.VertexScreening = [](const Point& x) { return x[1] * x[1]; }; } },
    { "screening in cells",
      [](ElementProblem& p)
      {
        p.CellScreening = [](const Point& x) { return x[1] > 2 ? 3.0 : 0.0; };
        p.CellSource = columnsOf(Columns, wave);
      } },
    { "two materials",
      [](ElementProblem& p)
      {
        p.Conductivity = [](const Point& x) -> Eigen::Matrix3d
        { return (x[0] < 3 ? 1.0 : 50.0) * Eigen::Matrix3d::Identity(); };
        p.VertexSource = columnsOf(Columns, wave);
      } },
    { "tensor",
      [](ElementProblem& p)
      {
        p.Conductivity = someTensor;
        p.VertexSource = columnsOf(Columns, wave);
      } },
    { "field",
      [](ElementProblem& p)
      {
        p.CellField = [](const Point& x)
        {
          Eigen::MatrixXd q(3, Columns);
          q << x[1], 2.0, std::sin(x[0]), -1.0, x[2], x[0];
          return q;
        };
      } },
    { "flux",
      [](ElementProblem& p)
      {
        p.FluxConditions.push_back({ above(0, 4.0), columnsOf(Columns, wave) });
        p.FluxConditions.push_back(
          { below(1, 0.7), columnsOf(Columns, [](const Point&, int k) { return 1.0 + k; }) });
      } },
    { "heat transfer",
      [](ElementProblem& p)
      {
        p.RobinConditions.push_back({ above(0, 4.0),
          [](const Point& x) { return 0.5 + 0.1 * std::fabs(x[1]); }, columnsOf(Columns, wave) });
      } },
    { "all at once",
      [](ElementProblem& p)
      {
        p.Conductivity = someTensor;
        p.CellScreening = [](const Point&) { return 0.2; };
        p.VertexScreening = [](const Point&) { return 0.1; };
        p.CellSource = p.VertexSource = columnsOf(Columns, wave);
        p.CellField = [](const Point&) -> Eigen::MatrixXd
        { return Eigen::MatrixXd::Constant(3, Columns, 0.4); };
        p.FluxConditions.push_back({ above(0, 4.0), columnsOf(Columns, wave) });
        p.RobinConditions.push_back(
          { above(1, 3.0), [](const Point&) { return 2.0; }, columnsOf(Columns, wave) });
      } },
  };
}

std::vector<StreamMesh> meshes()
{
  return { patch(), block() };
}

ElementProblem problemOf(const StreamMesh& mesh, const Datum& datum)
{
  ElementProblem problem(mesh);
  problem.Columns = Columns;
  holdOneEnd(problem);
  datum.set(problem);
  return problem;
}

} // namespace

TEST(EllipticFamily, AgreesWithADirectSolve)
{
  for (const StreamMesh& mesh : meshes())
  {
    for (const Datum& datum : data())
    {
      ElementProblem problem = problemOf(mesh, datum);
      const Solved solved = solveMesh(mesh, problem, accurate(1e-11));
      EXPECT_TRUE(solved.report.converged) << datum.name;
      EXPECT_LT(relativeError(solved.values, DirectElements(problem).solve()), 1e-7) << datum.name;
    }
  }
}

namespace
{

/** The unit square in 12 x 28 rectangles of two triangles, with vertices moved at random, squeezed
 * to a tenth in y: cells of about 1 : 23. */
StreamMesh flatCells(Random& random)
{
  constexpr int Columns = 13, Rows = 29;
  constexpr double Jitter = 0.3, Flatness = 0.1;
  IndexedTestMesh mesh{ CellType::Triangle, {}, {} };
  for (int i = 0; i < Columns; ++i)
  {
    for (int j = 0; j < Rows; ++j)
    {
      const bool isInside = i > 0 && i < Columns - 1 && j > 0 && j < Rows - 1;
      const double most = isInside ? Jitter : 0.0;
      const double x = double(i) / (Columns - 1) + most / Columns * random.uniform(-1.0, 1.0);
      const double y = double(j) / (Rows - 1) + most / Rows * random.uniform(-1.0, 1.0);
      mesh.positions.insert(mesh.positions.end(), { x, Flatness * y, 0.0 });
      if (i > 0 && j > 0)
      {
        const std::int64_t c = i * Rows + j, a = c - Rows - 1, b = c - 1, d = c - Rows;
        mesh.corners.insert(mesh.corners.end(), { a, b, c, a, c, d });
      }
    }
  }
  return toStream(mesh);
}

} // namespace

/** Flat cells have large negative weights, and coarse operators of random conductivities may lose
 * definiteness with the entries that are removed from them. */
TEST(EllipticFamily, FlatCellsOfAnyConductivityAreSolved)
{
  Combinations combinations;
  // One of these is not definite on the coarsest level.
  for (std::uint64_t seed = 600; seed < 850; ++seed)
  {
    if (!combinations.next())
    {
      continue;
    }
    SCOPED_TRACE(seed);
    Random random(seed);
    const StreamMesh mesh = flatCells(random);
    ElementProblem problem(mesh);
    problem.Conductivity = [seed](const Point& x) -> Eigen::Matrix3d
    {
      Random any(
        seed + std::bit_cast<std::uint64_t>(x[0]) + 3 * std::bit_cast<std::uint64_t>(x[1]));
      return std::pow(1e3, any.uniform(0.0, 1.0)) * Eigen::Matrix3d::Identity();
    };
    const auto constant = [](double value)
    { return columnsOf(1, [value](const Point&, int) { return value; }); };
    problem.DirichletConditions = { { below(0, 1e-6), constant(0.0) },
      { above(0, 1 - 1e-6), constant(1.0) } };
    const Solved solved = solveMesh(mesh, problem, accurate(1e-11));
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LE(solved.report.cycles, 30);
    EXPECT_LT(relativeError(solved.values, DirectElements(problem).solve()), 1e-6);
  }
}

namespace
{

/** A condition that holds a body without prescribed values, of any size. */
struct Hold
{
  std::string name;
  std::function<void(ElementProblem&, double)> set;
};

std::vector<Hold> holds()
{
  const auto robin = [](ElementProblem& p, double size, const ElementProblem::Where& where)
  {
    p.RobinConditions.push_back(
      { where, [size](const Point&) { return size; }, columnsOf(Columns, wave) });
  };
  return {
    { "Robin everywhere", [robin](ElementProblem& p, double size)
      { robin(p, size, [](const Point&) { return true; }); } },
    { "Robin at one end",
      [robin](ElementProblem& p, double size) { robin(p, size, above(0, 2.5)); } },
    { "screening", [](ElementProblem& p, double size)
      { p.VertexScreening = [size](const Point& x) { return size * (1 + x[1] * x[1]); }; } },
    { "screening of a part", [](ElementProblem& p, double size)
      { p.CellScreening = [size](const Point& x) { return x[1] > 2 ? size : 0.0; }; } },
  };
}

/** The solution of (L + S) u = F without prescribed values, as c + y with c = sum of F / sum of S:
 * (L + S) y = F - S c, by a dense factor in extended precision, for which no size of S is too
 * small. S is summed by itself: in the diagonal of L + S its digits are lost. */
Eigen::MatrixXd heldSolution(const ElementProblem& problem)
{
  const DirectElements system(problem);
  const Eigen::Index n = system.matrix.rows();
  Eigen::VectorXd hold = system.screening;
  for (const DirectElements::Facet& facet : system.boundary)
  {
    const int robin = problem.conditionOf(problem.RobinConditions, facet.corners);
    for (const std::int64_t v : facet.corners)
    {
      hold[v] += robin < 0 ? 0.0
                           : facet.area / static_cast<double>(facet.corners.size()) *
                               problem.RobinConditions[robin].coefficient(problem.vertex(v));
    }
  }
  const Eigen::RowVectorXd c = system.rightSide.colwise().sum() / hold.sum();
  // In extended precision the matrix is regular for all sizes of this test.
  using Real = long double;
  const Eigen::SparseMatrix<Real> matrix = system.stiffness.cast<Real>();
  const Eigen::Matrix<Real, -1, -1> dense =
    Eigen::Matrix<Real, -1, -1>(matrix) -
    Eigen::Matrix<Real, -1, -1>((matrix * Eigen::Matrix<Real, -1, 1>::Ones(n)).asDiagonal()) +
    Eigen::Matrix<Real, -1, -1>(hold.cast<Real>().asDiagonal());
  const Eigen::Matrix<Real, -1, -1> rest =
    dense.ldlt().solve((system.rightSide - hold * c).cast<Real>());
  return rest.cast<double>().rowwise() + c;
}

} // namespace

TEST(EllipticFamily, ConditionsOfAllSizesHoldABody)
{
  for (const StreamMesh& mesh : { patch(9, 8), block(4, 4, 5) })
  {
    for (const Hold& hold : holds())
    {
      for (int exponent = -15; exponent <= 16; ++exponent)
      {
        ElementProblem problem(mesh);
        problem.Columns = Columns;
        problem.VertexSource = columnsOf(Columns, wave);
        hold.set(problem, std::pow(10.0, exponent));
        const std::string name = hold.name + " 1e" + std::to_string(exponent);
        const Solved solved = solveMesh(mesh, problem, accurate(1e-9));
        EXPECT_TRUE(solved.report.converged) << name;
        EXPECT_EQ(solved.report.free_components, 0) << name;
        EXPECT_LT(relativeError(solved.values, heldSolution(problem)), 1e-8) << name;
      }
    }
  }
}

/** Without a source the solution is nearly a constant, and may be nearer to the initial values than
 * the rounding of these. */
TEST(EllipticFamily, AmbientValuesOfAllSizesHoldABodyFromAnyInitialValues)
{
  const std::vector<ElementProblem::Values> starts = { columnsOf(Columns,
                                                         [](const Point&, int) { return 0.7; }),
    columnsOf(Columns, [](const Point&, int k) { return 293.0 - 1e4 * k; }),
    columnsOf(Columns, [](const Point& p, int k) { return 293.0 + wave(p, k); }) };
  std::vector<Hold> robin = holds();
  std::erase_if(robin, [](const Hold& hold) { return !hold.name.starts_with("Robin"); });
  ASSERT_EQ(robin.size(), 2U);
  for (const StreamMesh& mesh : { patch(9, 8), block(4, 4, 5) })
  {
    for (const Hold& hold : robin)
    {
      for (int exponent = -13; exponent <= 13; ++exponent)
      {
        for (std::size_t start = 0; start < starts.size(); ++start)
        {
          ElementProblem problem(mesh);
          problem.Columns = Columns;
          problem.Initial = starts[start];
          hold.set(problem, std::pow(10.0, exponent));
          const std::string name =
            hold.name + " 1e" + std::to_string(exponent) + " from " + std::to_string(start);
          const Solved solved = solveMesh(mesh, problem, SolveOptions());
          EXPECT_TRUE(solved.report.converged) << name;
          EXPECT_LE(solved.report.cycles, 25) << name;
          EXPECT_LT(relativeError(solved.values, heldSolution(problem)), 1e-5) << name;
        }
      }
    }
  }
}

/** All of the initial values is error. */
TEST(EllipticFamily, AmbientValuesOfZeroAreReachedWhateverTheirCoefficients)
{
  for (const StreamMesh& mesh : { patch(9, 8), block(4, 4, 5) })
  {
    for (int exponent = -13; exponent <= -4; ++exponent)
    {
      ElementProblem problem(mesh);
      problem.Initial = columnsOf(1, [](const Point& p, int) { return 293.0 + wave(p, 0); });
      problem.RobinConditions.push_back(
        { above(0, 2.5), [=](const Point&) { return std::pow(10.0, exponent); },
          columnsOf(1, [](const Point&, int) { return 0.0; }) });
      const Solved solved = solveMesh(mesh, problem, SolveOptions());
      EXPECT_TRUE(solved.report.converged) << "1e" << exponent;
      EXPECT_LT(solved.values.cwiseAbs().maxCoeff(), 1e-3) << "1e" << exponent;
    }
  }
}

/** The divergence of a field sums to zero on the mesh but for rounding, which beside a tiny
 * screening would be any mean. */
TEST(EllipticFamily, AFieldHasTheMeanZeroHoweverSmallTheScreening)
{
  for (const StreamMesh& mesh : { patch(9, 8), block(4, 4, 5) })
  {
    for (int exponent = -24; exponent <= 0; exponent += 2)
    {
      ElementProblem problem(mesh);
      problem.CellField = [](const Point& p) -> Eigen::MatrixXd
      { return Eigen::Vector3d(1.0 + p[1], std::sin(p[0]), 0.3); };
      problem.VertexScreening = [=](const Point&) { return std::pow(10.0, exponent); };
      problem.Initial = columnsOf(1, [](const Point&, int) { return 5.0; });
      const Solved solved = solveMesh(mesh, problem, accurate(1e-10));
      EXPECT_TRUE(solved.report.converged) << exponent;
      const double range = solved.values.maxCoeff() - solved.values.minCoeff();
      EXPECT_GT(range, 0.1) << exponent;
      const Eigen::VectorXd mass = DirectElements(problem).mass;
      EXPECT_LT(std::fabs(mass.dot(solved.values.col(0)) / mass.sum()), 1e-7 * range) << exponent;
    }
  }
}

TEST(EllipticFamily, BodiesThatAreHeldLooselyDoNotKnowEachOther)
{
  // One body has a large constant, one a prescribed value, one no condition.
  const IndexedTestMesh shape = tetBox(4, 4, 5, 0.15);
  const StreamMesh one = toStream(shape);
  const StreamMesh three =
    toStream(disjointUnion(disjointUnion(shape, shape, { 100, 0, 0 }), shape, { 200, 0, 0 }));
  ElementProblem problem(three);
  problem.VertexSource = columnsOf(1, [](const Point& p, int) { return std::sin(p[1]) + 1; });
  problem.RobinConditions.push_back({ below(0, 50), [](const Point&) { return 1e-12; },
    columnsOf(1, [](const Point&, int) { return 3.0; }) });
  problem.DirichletConditions.push_back({ [](const Point& p) { return p[0] > 50 && p[0] < 100.6; },
    columnsOf(1, [](const Point& p, int) { return p[1]; }) });
  const Solved solved = solveMesh(three, problem, accurate(1e-9));
  EXPECT_TRUE(solved.report.converged);
  EXPECT_EQ(solved.report.free_components, 1);
  ElementProblem alone(one);
  alone.VertexSource = problem.VertexSource;
  alone.RobinConditions = problem.RobinConditions;
  const Eigen::MatrixXd expected = heldSolution(alone);
  double largest = 0.0, others = 0.0;
  for (std::int64_t v = 0; v < three.vertices(); ++v)
  {
    (three.positions[3 * v] < 50 ? largest : others) =
      std::max(three.positions[3 * v] < 50 ? largest : others, std::fabs(solved.values(v, 0)));
  }
  EXPECT_NEAR(largest / expected.maxCoeff(), 1.0, 1e-9);
  EXPECT_LT(others, 1e4);
}

TEST(EllipticFamily, DoesNotDependOnBlocksNorThreads)
{
  for (const StreamMesh& mesh : meshes())
  {
    ElementProblem problem = problemOf(mesh, data().back());
    SolveOptions options;
    options.maxCycles = 2;
    options.tolerance = 1e-12;
    options.inCore = true;
    const Solved expected = solveMesh(mesh, problem, options);
    options.inCore = false;
    options.coreNodes = 30;
    for (const std::int64_t cells : { 1, 7, 64, 65, 256, 100000 })
    {
      options.threads = cells % 2 == 0 ? 1 : 2;
      options.blockNodes = 1 + cells % 100;
      EXPECT_TRUE(sameBits(solveMesh(mesh, problem, options, cells).values, expected.values))
        << "blocks of " << cells << " cells";
    }
  }
}

TEST(EllipticFamily, DoesNotDependOnTheUnits)
{
  // Lengths in mm instead of m, and a conductivity in another unit: u does not change.
  for (StreamMesh mesh : meshes())
  {
    const auto solve = [&](double length, double unit)
    {
      StreamMesh scaled = mesh;
      for (double& coordinate : scaled.positions)
      {
        coordinate *= length;
      }
      ElementProblem problem(scaled);
      problem.DirichletConditions.push_back({ [=](const Point& p) { return p[0] < 0.6 * length; },
        columnsOf(1, [=](const Point& p, int) { return p[1] / length; }) });
      problem.Conductivity = [=](const Point& p) -> Eigen::Matrix3d
      { return unit * someTensor(p / length); };
      problem.CellSource =
        columnsOf(1, [=](const Point&, int) { return unit / (length * length); });
      const Solved solved = solveMesh(scaled, problem, accurate(1e-11));
      EXPECT_TRUE(solved.report.converged);
      EXPECT_TRUE(solved.report.notes.empty());
      return solved.values;
    };
    const Eigen::MatrixXd expected = solve(1.0, 1.0);
    for (const auto& [length, unit] :
      { std::pair{ 1e3, 1.0 }, std::pair{ 1e-3, 1e-9 }, std::pair{ 1e-3, 1e9 } })
    {
      EXPECT_LT(relativeError(solve(length, unit), expected), 2e-7) << length << " " << unit;
    }
  }
}

TEST(EllipticFamily, AFieldThatIsAGradientGivesItsFunctionBack)
{
  for (const StreamMesh& mesh : meshes())
  {
    ElementProblem problem(mesh);
    const Eigen::Vector3d slope(1.0, -2.0, 0.5);
    problem.Conductivity = someTensor;
    problem.CellField = [&](const Point& p) -> Eigen::MatrixXd { return someTensor(p) * slope; };
    problem.Initial = columnsOf(1, [&](const Point& p, int) { return p.dot(slope); });
    // The function is the initial value; from zero, it is found up to its mean.
    const Solved there = solveMesh(mesh, problem, accurate());
    if (mesh.cellType == CellType::Tetrahedron)
    {
      EXPECT_LT(relativeError(there.values, positionsOf(mesh) * slope), 1e-7);
    }
    EXPECT_LT(relativeError(there.values, DirectElements(problem).solve()), 1e-7);
    problem.Initial = {};
    const Solved found = solveMesh(mesh, problem, accurate(1e-11));
    EXPECT_LT(relativeError(found.values, DirectElements(problem).solve()), 1e-7);
  }
}

TEST(EllipticFamily, ABoundaryThatTransfersHeatDeterminesTheSolution)
{
  for (const StreamMesh& mesh : meshes())
  {
    ElementProblem problem(mesh);
    problem.RobinConditions.push_back({ above(0, 4.0), [](const Point&) { return 2.0; },
      columnsOf(1, [](const Point&, int) { return 7.0; }) });
    const Solved solved = solveMesh(mesh, problem, accurate());
    EXPECT_EQ(solved.report.free_components, 0);
    EXPECT_LT((solved.values.array() - 7.0).abs().maxCoeff(), 1e-8);
  }
}

/** Their initial residual is as large as the conditions, which is no measure for other rows. */
TEST(EllipticFamily, StiffConditionsAreSolvedLikeOthers)
{
  for (const StreamMesh& mesh : meshes())
  {
    for (const double stiffness : { 1e3, 1e6, 1e9 })
    {
      ElementProblem robin(mesh);
      robin.CellSource = columnsOf(1, wave);
      robin.RobinConditions.push_back(
        { [](const Point&) { return true; }, [=](const Point&) { return stiffness; },
          columnsOf(1, [](const Point&, int) { return 3.0; }) });
      ElementProblem screened(mesh);
      holdOneEnd(screened);
      screened.Columns = Columns;
      screened.VertexScreening = [=](const Point& p) { return p[0] > 4.0 ? stiffness : 0.0; };
      screened.VertexSource = columnsOf(
        Columns, [=](const Point& p, int k) { return p[0] > 4.0 ? stiffness * (1.0 + k) : 0.0; });
      for (ElementProblem* problem : { &robin, &screened })
      {
        SolveOptions options;
        options.tolerance = 1e-8;
        const Solved solved = solveMesh(mesh, *problem, options);
        EXPECT_TRUE(solved.report.converged) << stiffness;
        const Eigen::MatrixXd direct = DirectElements(*problem).solve();
        EXPECT_LT(relativeError(solved.values, direct), 1e-6) << stiffness;
      }
    }
  }
}

TEST(EllipticFamily, FluxesThatDoNotSumToZeroLoseTheirMeanBySources)
{
  for (const StreamMesh& mesh : meshes())
  {
    ElementProblem problem(mesh);
    problem.Columns = Columns;
    problem.FluxConditions.push_back({ above(0, 4.0), columnsOf(Columns, wave) });
    problem.Initial = columnsOf(Columns, [](const Point& p, int k) { return p[k]; });
    const Solved solved = solveMesh(mesh, problem, accurate(1e-11));
    EXPECT_TRUE(hasNote(solved.report, "do not sum to zero"));
    const DirectElements direct(problem);
    EXPECT_LT(relativeError(solved.values, direct.solve()), 1e-7);
    for (int k = 0; k < Columns; ++k)
    {
      EXPECT_NEAR(solved.report.removed_source[k], direct.rightSide.col(k).sum(),
        1e-12 * direct.rightSide.cwiseAbs().sum());
    }
  }
}

TEST(EllipticFamily, ConditionsInsideAreNoBoundary)
{
  for (const StreamMesh& mesh : { toStream(shuffled(torus(30, 20, 0.3))), block() })
  {
    ElementProblem problem(mesh);
    problem.Columns = Columns;
    holdOneEnd(problem);
    const Solved expected = solveMesh(mesh, problem, accurate());
    const bool closed = mesh.cellType == CellType::Triangle;
    // Everywhere on a closed surface, or in the interior of a solid.
    problem.FluxConditions.push_back({ [=](const Point& p)
      { return closed || (p.minCoeff() > 0.5 && p[0] < 6.0 && p[1] < 4.5 && p[2] < 6.5); },
      columnsOf(Columns, wave) });
    EXPECT_TRUE(sameBits(solveMesh(mesh, problem, accurate()).values, expected.values));
  }
}

} // namespace smg::testing
