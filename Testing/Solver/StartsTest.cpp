// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Solver/EllipticTesting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

// What a solve stops at is a property of the problem, not of where the iteration begins: laws over
// random problems with a direct solve as oracle.

namespace smg::testing
{
namespace
{

constexpr int Columns = 2;

/** A random mesh, of one body or two, and a problem on it. */
struct RandomProblem
{
  explicit RandomProblem(std::uint64_t seed);

  ElementProblem problem() const
  {
    ElementProblem problem(*this->mesh);
    problem.Columns = Columns;
    this->set(problem, 0.0);
    return problem;
  }

  std::unique_ptr<StreamMesh> mesh;
  /** Sets the data; all prescribed and ambient values, and what screening pulls to, plus `offset`.
   */
  std::function<void(ElementProblem&, double offset)> set;
  bool isHeld = false; ///< whether anything holds the constant
};

RandomProblem::RandomProblem(std::uint64_t seed)
{
  Random random(seed);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  const auto size = [&](int low, int high)
  { return low + static_cast<int>(random.below(high - low)); };
  const bool isSolid = random.below(3) == 0;
  this->mesh = std::make_unique<StreamMesh>(
    isSolid ? block(size(5, 10), size(5, 9), size(5, 9)) : patch(size(12, 40), size(12, 40)));
  const auto phase = std::array{ uniform(0, 3), uniform(0, 3), uniform(0.2, 1.0) };
  const auto wave = [phase](const Point& p, int k) {
    return std::sin(phase[2] * p[0] + k + phase[0]) + 0.3 * std::cos(p[1] - 0.5 * p[2] + phase[1]);
  };
  // Quantities of their own units.
  const auto unit = std::array{ 1.0, std::pow(10.0, uniform(-6, 6)) };
  const auto values = [=](double of, double offset)
  {
    return columnsOf(
      Columns, [=](const Point& p, int k) { return unit[k] * (of * wave(p, k) + offset); });
  };
  const auto has = [&] { return random.below(2) == 0; };
  const bool hasDirichlet = has(), hasRobin = has(), hasScreening = has(), hasFlux = has();
  const bool hasSource = has() || !(hasDirichlet || hasRobin || hasScreening || hasFlux);
  const bool hasConductivity = has();
  const double transfer = std::pow(10.0, uniform(-4, 3)),
               screening = std::pow(10.0, uniform(-4, 3));
  const double source = std::pow(10.0, uniform(-2, 2));
  this->isHeld = hasDirichlet || hasRobin || hasScreening;
  this->set = [=](ElementProblem& p, double offset)
  {
    if (hasConductivity)
    {
      p.Conductivity = someTensor;
    }
    if (hasDirichlet)
    {
      p.DirichletConditions.push_back({ below(0, 0.9), values(1.0, offset) });
    }
    if (hasRobin)
    {
      p.RobinConditions.push_back(
        { above(1, 3.0), [=](const Point&) { return transfer; }, values(1.0, offset) });
    }
    if (hasScreening)
    {
      p.VertexScreening = [=](const Point&) { return screening; };
    }
    if (hasFlux)
    {
      p.FluxConditions.push_back({ above(0, 4.0), values(source, 0.0) });
    }
    // A source beside screening pulls towards source / screening.
    const double pull = hasScreening ? screening : 0.0;
    if (hasSource || hasScreening)
    {
      p.VertexSource = columnsOf(Columns, [=](const Point& at, int k)
        { return unit[k] * ((hasSource ? source * wave(at, k) : 0.0) + pull * offset); });
    }
  };
}

/** Makes these the initial values. */
void beginAt(ElementProblem& problem, const Eigen::MatrixXd& values)
{
  auto places = std::make_shared<std::map<std::array<double, 3>, Eigen::VectorXd>>();
  for (std::int64_t v = 0; v < problem.mesh().vertices(); ++v)
  {
    const Point p = problem.vertex(v);
    (*places)[{ p[0], p[1], p[2] }] = values.row(v);
  }
  problem.Initial = [places](const Point& p) { return places->at({ p[0], p[1], p[2] }); };
}

Eigen::RowVectorXd rangesOf(const Eigen::MatrixXd& values)
{
  return values.colwise().maxCoeff() - values.colwise().minCoeff();
}

/** The largest error over the range of its column; of problems that leave the constant open,
 * without the mean. */
double errorOf(const Solved& solved, const Eigen::MatrixXd& exact, bool isHeld)
{
  Eigen::MatrixXd error = solved.values - exact;
  if (!isHeld)
  {
    error.rowwise() -= error.colwise().mean();
  }
  return (error.cwiseAbs().colwise().maxCoeff().array() / rangesOf(exact).array()).maxCoeff();
}

Eigen::MatrixXd noise(std::uint64_t seed, const Eigen::MatrixXd& like)
{
  Random random(seed);
  const Eigen::RowVectorXd ranges = rangesOf(like);
  return Eigen::MatrixXd::NullaryExpr(like.rows(), like.cols(),
    [&](Eigen::Index, Eigen::Index k) { return ranges[k] * random.uniform(-1, 1); });
}

} // namespace

TEST(Starts, TheErrorIsTheToleranceOfTheRangeFromAnyStart)
{
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
  {
    const RandomProblem random(seed);
    const Eigen::MatrixXd exact = DirectElements(random.problem()).solve();
    if (rangesOf(exact).minCoeff() == 0.0)
    {
      continue; // the data are nowhere
    }
    const std::vector<Eigen::MatrixXd> starts{ Eigen::MatrixXd::Zero(exact.rows(), exact.cols()),
      noise(seed, exact), 100.0 * noise(seed + 1000, exact), exact + 1e-3 * noise(seed, exact),
      exact.rowwise() + 1e3 * rangesOf(exact) };
    for (const double tolerance : { 1e-4, 1e-6, 1e-8 })
    {
      for (std::size_t k = 0; k < starts.size(); ++k)
      {
        ElementProblem problem = random.problem();
        beginAt(problem, starts[k]);
        const Solved solved = solveMesh(*random.mesh, problem, accurate(tolerance));
        EXPECT_TRUE(solved.report.converged);
        EXPECT_LT(errorOf(solved, exact, random.isHeld), 10.0 * tolerance)
          << "seed " << seed << ", start " << k << ", tolerance " << tolerance << ", "
          << solved.report.cycles << " V-cycles";
      }
    }
  }
}

TEST(Starts, ABetterOneNeverTakesMoreCycles)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const RandomProblem random(seed);
    const Eigen::MatrixXd exact = DirectElements(random.problem()).solve();
    const Eigen::MatrixXd far = noise(seed, exact);
    int before = INT_MAX;
    for (const double distance : { 10.0, 1.0, 1e-2, 1e-4, 1e-6, 0.0 })
    {
      ElementProblem problem = random.problem();
      beginAt(problem, exact + distance * far);
      const Report report = solveMesh(*random.mesh, problem, accurate(1e-6)).report;
      EXPECT_LE(report.cycles, before) << "seed " << seed << ", distance " << distance;
      before = report.cycles;
    }
    if (random.isHeld)
    {
      EXPECT_EQ(before, 0) << "seed " << seed;
    }
  }
}

TEST(Starts, OffsetsAndScalesChangeNothing)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const RandomProblem random(seed);
    const auto solved = [&](double offset)
    {
      ElementProblem problem(*random.mesh);
      problem.Columns = Columns;
      random.set(problem, offset);
      return solveMesh(*random.mesh, problem, accurate(1e-6));
    };
    // The start stays at 0: an offset is a worse one.
    const Solved with = solved(1e4), without = solved(0.0);
    EXPECT_LE(without.report.cycles, with.report.cycles) << seed;
    EXPECT_LE(with.report.cycles, without.report.cycles + 6) << seed;
    EXPECT_EQ(with.report.relative_to, "the best constant");
  }
}

TEST(Starts, TheSolutionTakesNoCycleAndSaysSo)
{
  const StreamMesh mesh = patch(30, 20);
  ElementProblem problem(mesh);
  problem.DirichletConditions.push_back(
    { below(0, 0.9), columnsOf(1, [](const Point& p, int) { return p[1]; }) });
  problem.VertexSource = columnsOf(1, [](const Point& p, int) { return p[0]; });
  beginAt(problem, DirectElements(problem).solve());
  // The weights of the engine have single precision.
  const Report report = solveMesh(mesh, problem, accurate(1e-6)).report;
  EXPECT_EQ(report.cycles, 0);
  EXPECT_TRUE(report.converged && hasNote(report, "no V-cycle was needed"));
}

} // namespace smg::testing
