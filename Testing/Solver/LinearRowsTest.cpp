// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Setup/LinearRows.h"
#include "Testing/Solver/CoarseningTesting.h"
#include "Testing/Solver/SolveTesting.h"
#include "Testing/Support/Refinement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace smg::testing
{
namespace
{

/** A node at the origin with C-points in these places and a row with these entries. */
class FittedRow
{
public:
  FittedRow(const Eigen::MatrixX3d& places, const Eigen::VectorXd& entries, double sum = 1.0)
    : Fine(this->Memory)
    , Coarse(this->Memory)
    , Data(this->Memory, this->Fine, this->Coarse)
  {
    this->Fine.open(0);
    this->Fine.close(0, 0.0, -1);
    std::fill_n(this->Fine.place(1), 3, 0.0F);
    this->Data.publishedCoarse = entries.size();
    this->Data.coarsePoint.extendRaw(entries.size());
    this->Row.size = static_cast<std::int8_t>(entries.size());
    this->Row.sum = static_cast<float>(sum);
    for (Eigen::Index k = 0; k < entries.size(); ++k)
    {
      for (Eigen::Index x = 0; x < 3; ++x)
      {
        this->Data.coarsePoint.at(k)[x] = static_cast<float>(places(k, x));
      }
      this->Row.entry[k] = { static_cast<CoarseIndex>(k), static_cast<float>(entries[k]) };
    }
  }

  Eigen::VectorXd fitted()
  {
    LinearRows::fit(this->Data, 0, this->Row);
    Eigen::VectorXd entries(this->Row.size);
    for (Eigen::Index k = 0; k < entries.size(); ++k)
    {
      entries[k] = static_cast<double>(this->Row.entry[k].value());
    }
    return entries;
  }

private:
  Pool Memory{ 1 << 24 };
  LevelRows Fine, Coarse;
  CoarseningData Data;
  RelaxedRow Row;
};

/** The solution of the same problem with a Lagrange multiplier for the sum. */
Eigen::VectorXd expectedFit(
  const Eigen::MatrixX3d& places, const Eigen::VectorXd& entries, double tolerance)
{
  const Eigen::Index n = entries.size();
  const Eigen::MatrixX3d b = places / places.rowwise().norm().maxCoeff();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(n + 1, n + 1);
  const Eigen::VectorXd near = (entries.cwiseAbs().array() + LinearRows::Slack).inverse();
  matrix.topLeftCorner(n, n) = b * b.transpose() / (tolerance * tolerance);
  matrix.topLeftCorner(n, n) += near.asDiagonal();
  matrix(n, n) = 0.0;
  Eigen::VectorXd right = Eigen::VectorXd::Ones(n + 1);
  right.head(n) = near.cwiseProduct(entries);
  return matrix.fullPivLu().solve(right).head(n);
}

Eigen::VectorXd normalised(Eigen::VectorXd entries)
{
  return entries / entries.sum();
}

/** A surface with a few caps of up to 179.9 degrees in its coarse triangles, refined. */
StreamMesh lattices(int times, double moved = 0.0)
{
  IndexedTestMesh mesh = withCaps(torus(24, 13, 0.3), 150);
  for (int k = 0; k < times; ++k)
  {
    mesh = refined(mesh);
  }
  for (double& x : mesh.positions)
  {
    // Multiples of 2^-20, so that all differences are exact wherever the mesh lies.
    x = std::round(std::ldexp(x, 20)) / std::ldexp(1.0, 20) + moved;
  }
  return toStream(mesh);
}

} // namespace

TEST(LinearRows, AreTheSolutionsOfTheLeastSquaresProblem)
{
  Random random(3);
  int exact = 0, loose = 0, left = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Eigen::Index n = 2 + trial % 4;
    Eigen::MatrixX3d places(n, 3);
    Eigen::VectorXd entries(n);
    // Lattices of caps are nearly lines: flat in one direction, still more so in another.
    for (Eigen::Index k = 0; k < n; ++k)
    {
      places.row(k) << random.uniform(-1.0, 1.0), random.uniform(-0.1, 0.1),
        random.uniform(-0.01, 0.01);
      entries[k] = random.uniform(-0.3, 1.0);
    }
    entries = normalised(entries);
    if (!entries.allFinite() || entries.cwiseAbs().maxCoeff() > 3.0)
    {
      continue;
    }
    const Eigen::VectorXd fitted = FittedRow(places, entries).fitted();
    const auto within = [](const Eigen::VectorXd& row, double slack)
    {
      return row.minCoeff() >= LinearRows::Least - slack &&
             row.maxCoeff() <= LinearRows::Most + slack;
    };
    Eigen::VectorXd expected = expectedFit(places, entries, LinearRows::Exact);
    if (within(expected, 0.0) != within(expected, 1e-4))
    {
      continue; // rounding decides
    }
    if (within(expected, 0.0))
    {
      ++exact;
    }
    else
    {
      expected = expectedFit(places, entries, LinearRows::Loose);
      const bool fits = within(expected, 0.0);
      if (fits != within(expected, 1e-4))
      {
        continue;
      }
      ++(fits ? loose : left);
      expected = fits ? expected : entries;
    }
    ASSERT_LT((fitted - expected).cwiseAbs().maxCoeff(), 1e-5) << trial;
  }
  EXPECT_GT(exact, 500);
  EXPECT_GT(loose, 20);
  EXPECT_GT(left, 20);
}

TEST(LinearRows, StayNextToConstraintsAndWhereAllNodesCoincide)
{
  Eigen::MatrixX3d places(3, 3);
  places << 1.0, 0.0, 0.0, -1.0, 0.1, 0.0, 0.0, -1.0, 0.0;
  const Eigen::VectorXd entries = normalised(Eigen::Vector3d(0.7, 0.2, 0.1));
  EXPECT_NE(FittedRow(places, entries).fitted(), entries.cast<float>().cast<double>());
  EXPECT_EQ(FittedRow(places, entries, 0.9).fitted(), entries.cast<float>().cast<double>());
  places.setZero();
  EXPECT_EQ(FittedRow(places, entries).fitted(), entries.cast<float>().cast<double>());
}

TEST(LinearRows, ReproducePositionsInLatticesOfCaps)
{
  const StreamMesh mesh = lattices(3);
  TestLevel level = finestLevel(mesh, Weights::Cotangent);
  RecordingOperators operators;
  operators.cancellingStrength = 0.6F;
  double error[2];
  for (const bool placed : { false, true })
  {
    if (placed)
    {
      level.points.assign(mesh.positions.begin(), mesh.positions.end());
    }
    const CoarsenedLevel step = coarsen(level, operators, 1000);
    EXPECT_TRUE(sameLevels(step.coarse, coarsen(level, operators, 17).coarse));
    double squares = 0.0, sizes = 0.0;
    std::vector<std::int64_t> cPoint(step.coarse.nodes());
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      if (step.record.coarseIndex[i] >= 0)
      {
        cPoint[step.record.coarseIndex[i]] = i;
      }
    }
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      double terms = 0.0;
      for (const RowEntry& entry : level.rows[i])
      {
        terms += std::fabs(static_cast<double>(entry.weight()));
      }
      if (step.record.coarseIndex[i] >= 0 || terms < 1.25 * level.diagonal(i))
      {
        continue;
      }
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double farthest = 0.0;
      for (const auto& [coarse, weight] : step.record.sweeps.back()[i].entries)
      {
        const Eigen::Vector3d from =
          Eigen::Map<const Eigen::Vector3d>(mesh.positions.data() + 3 * cPoint[coarse]) -
          Eigen::Map<const Eigen::Vector3d>(mesh.positions.data() + 3 * i);
        sum += static_cast<double>(weight) * from;
        farthest = std::max(farthest, from.squaredNorm());
      }
      squares += sum.squaredNorm();
      sizes += farthest;
    }
    error[placed] = std::sqrt(squares / sizes);
    // Coarse nodes are where their C-points are.
    ASSERT_EQ(step.coarse.points.size(), placed ? 3 * cPoint.size() : 0);
    for (std::size_t k = 0; k < step.coarse.points.size(); ++k)
    {
      ASSERT_EQ(step.coarse.points[k], level.points[3 * cPoint[k / 3] + k % 3]);
    }
  }
  EXPECT_LT(error[true], 0.5 * error[false]);
}

TEST(LinearRows, DoNotDependOnThePlaceOfTheMesh)
{
  Eigen::MatrixXd solutions[2];
  for (const bool moved : { false, true })
  {
    const StreamMesh mesh = lattices(2, moved ? std::ldexp(1.0, 21) : 0.0);
    ArrayProblem problem = heldEnds(mesh, 2, Weights::Cotangent);
    SolveOptions options;
    options.tolerance = 1e-6;
    solutions[moved] = solveMesh(mesh, problem, options, 500).values;
  }
  EXPECT_TRUE(sameBits(solutions[false], solutions[true]));
}

} // namespace smg::testing
