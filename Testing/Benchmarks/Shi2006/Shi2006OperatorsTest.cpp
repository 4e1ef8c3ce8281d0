// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/Shi2006/EdgeOperators.h"
#include "Testing/Benchmarks/Shi2006/Shi2006Testing.h"
#include "Testing/Support/AllIndices.h"
#include "Testing/Support/EdgeWeights.h"

#include <gtest/gtest.h>

#include <functional>

// Compares each operator with dense algebra.

namespace smg::testing
{
namespace
{

using shi2006::Edge;
using shi2006::Level;

/** Two steps of coarsening of a problem with all data. */
struct Hierarchy
{
  explicit Hierarchy(const StreamMesh& mesh, ArrayProblem problem)
    : assembled(mesh, problem)
    , next(assembled.coarsen(assembled.level))
    , last(assembled.coarsen(next))
  {
  }
  Level& finest() { return this->assembled.level; }

  /** Restricts to level 2, with intermediate sweeps, so that no value is zero. */
  void restrictAll()
  {
    shi2006::relax(this->finest());
    shi2006::restrictRightSide(this->finest(), this->next);
    shi2006::relax(this->next);
    shi2006::restrictRightSide(this->next, this->last);
    shi2006::relax(this->last);
  }

  AssembledLevel assembled;
  Level next, last;
};

/** Scattered constraints, a source, screening, non-integrable targets. */
ArrayProblem richProblem(const StreamMesh& mesh, Weights weights)
{
  ArrayProblem problem;
  problem.Columns = 3;
  problem.EdgeWeights = weights;
  problem.Screening = 0.05;
  problem.Target = scaledEdges(3);
  Random random(3);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    problem.Prescribed.push_back(v % 11 == 5);
    for (int k = 0; k < 3; ++k)
    {
      problem.Value.push_back(random.uniform(-1, 1));
      problem.Source.push_back(random.uniform(-1, 1));
    }
  }
  return problem;
}

/** Calls check(hierarchy) for surfaces and solids with both kinds of weights. */
void forHierarchies(const std::function<void(Hierarchy&)>& check)
{
  for (const StreamMesh& mesh : { toStream(torus(24, 12, 0.3)), toStream(tetBox(7, 6, 6, 0.15)) })
  {
    for (const Weights weights : { Weights::Uniform, Weights::Clamped })
    {
      Hierarchy hierarchy(mesh, richProblem(mesh, weights));
      ASSERT_GT(hierarchy.last.nodes(), 5);
      check(hierarchy);
    }
  }
}

/** Like forHierarchies, for both steps: check(fine, coarse). */
void forSteps(bool restricted, const std::function<void(Level&, Level&)>& check)
{
  forHierarchies(
    [&](Hierarchy& hierarchy)
    {
      if (restricted)
      {
        hierarchy.restrictAll();
      }
      check(hierarchy.finest(), hierarchy.next);
      check(hierarchy.next, hierarchy.last);
    });
}

/** The interpolation of corrections, (4) and (5) without g and xi. */
Eigen::MatrixXd denseInterpolation(const Level& fine, const Level& coarse)
{
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(fine.nodes(), coarse.nodes());
  for (std::int64_t i = 0; i < fine.nodes(); ++i)
  {
    if (fine.node[i].lifted())
    {
      p(i, fine.node[i].parent) = 1.0;
    }
  }
  forEdges(fine,
    [&](std::int64_t i, const Edge& edge, const double*)
    {
      const shi2006::Node& other = fine.node[edge.neighbour];
      if (!fine.node[i].lifted() && other.lifted())
      {
        p(i, other.parent) = edge.weight / fine.node[i].pull;
      }
    });
  return p;
}

double largest(const Eigen::MatrixXd& matrix)
{
  return matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().maxCoeff();
}

} // namespace

TEST(Shi2006Operators, LiftedNodesAreAMaximalIndependentSetInStreamOrder)
{
  forSteps(false,
    [](const Level& fine, const Level& coarse)
    {
      std::int64_t lifted = 0;
      for (std::int64_t i = 0; i < fine.nodes(); ++i)
      {
        bool lowerLifted = false;
        for (std::int64_t e = 0; e < fine.edges.size(i); ++e)
        {
          const std::int64_t j = fine.edges.row(i)[e].neighbour;
          lowerLifted = lowerLifted || (j < i && fine.node[j].lifted());
        }
        ASSERT_EQ(fine.node[i].lifted(), fine.edges.size(i) > 0 && !lowerLifted) << i;
        ASSERT_TRUE(!fine.node[i].lifted() || fine.node[i].parent == lifted++) << i;
      }
      EXPECT_EQ(coarse.nodes(), lifted);
    });
}

TEST(Shi2006Operators, TheCoarseMatrixIsTheSchurComplementOfTheTruncatedOne)
{
  forSteps(false,
    [](const Level& fine, const Level& coarse)
    {
      const Split split(fine);
      const Eigen::MatrixXd a = denseMatrix(fine, true);
      const Eigen::MatrixXd retained = a(split.retained, split.retained);
      const Eigen::MatrixXd between = a(split.lifted, split.retained);
      const Eigen::MatrixXd schur =
        a(split.lifted, split.lifted) - between * retained.inverse() * between.transpose();
      const Eigen::MatrixXd s = denseMatrix(coarse);
      EXPECT_LT(largest(s - schur), 1e-14 * largest(schur));
      // The coarse operator of the paper differs from P^T A P by the omitted edges.
      const Eigen::MatrixXd p = denseInterpolation(fine, coarse);
      const Eigen::MatrixXd full = denseMatrix(fine);
      const Eigen::MatrixXd galerkin = p.transpose() * full * p;
      EXPECT_LT(largest(galerkin - s - p.transpose() * (full - a) * p), 1e-13 * largest(galerkin));
      EXPECT_GT(largest(galerkin - s), 0.05 * largest(galerkin));
    });
}

TEST(Shi2006Operators, TheCoarseMatrixIsASymmetricMMatrixWithRowSumsAlpha)
{
  forSteps(false,
    [](const Level&, const Level& coarse)
    {
      const Eigen::MatrixXd s = denseMatrix(coarse);
      EXPECT_EQ(largest(s - s.transpose()), 0.0) << "to the last bit";
      for (std::int64_t i = 0; i < coarse.nodes(); ++i)
      {
        const shi2006::Node& node = coarse.node[i];
        EXPECT_GE(node.alpha, 0.0);
        EXPECT_NEAR(s.row(i).sum(), node.alpha, 1e-14 * s(i, i));
        EXPECT_NEAR(node.diagonal, s(i, i), 1e-14 * s(i, i));
      }
      forEdges(coarse,
        [](std::int64_t i, const Edge& edge, const double*)
        {
          EXPECT_GT(edge.weight, 0.0);
          EXPECT_NE(edge.neighbour, i);
        });
    });
}

TEST(Shi2006Operators, TheCoarseRightSideIsThatOfTheTruncatedSystem)
{
  forSteps(true,
    [](const Level& fine, const Level& coarse)
    {
      const Split split(fine);
      const Eigen::MatrixXd a = denseMatrix(fine, true);
      const Eigen::MatrixXd r = denseResidual(fine, true);
      const Eigen::MatrixXd retained = a(split.retained, split.retained);
      const Eigen::MatrixXd between = a(split.lifted, split.retained);
      const Eigen::MatrixXd expected =
        r(split.lifted, AllIndices) - between * retained.inverse() * r(split.retained, AllIndices);
      const Eigen::MatrixXd b = rowsOf(coarse.rightSide);
      EXPECT_LT(largest(b - expected), 1e-13 * largest(expected));
      const Eigen::MatrixXd restricted =
        denseInterpolation(fine, coarse).transpose() * denseResidual(fine, false);
      EXPECT_GT(largest(b - restricted), 1e-2 * largest(restricted));
    });
}

TEST(Shi2006Operators, TheVectorsOnCoarseEdgesAreThoseOfEquation8)
{
  forSteps(true,
    [](const Level& fine, const Level& coarse)
    {
      const Split split(fine);
      const Eigen::MatrixXd v = rowsOf(fine.value);
      for (int k = 0; k < fine.columns(); ++k)
      {
        Eigen::MatrixXd w = Eigen::MatrixXd::Zero(fine.nodes(), fine.nodes());
        Eigen::MatrixXd g = w; // g(i, j): of v_i - v_j
        forEdges(fine,
          [&](std::int64_t i, const Edge& edge, const double* target)
          {
            w(i, edge.neighbour) = edge.weight;
            g(i, edge.neighbour) = target[k] - (v(i, k) - v(edge.neighbour, k));
          });
        Eigen::MatrixXd coarseG = Eigen::MatrixXd::Zero(coarse.nodes(), coarse.nodes());
        Eigen::MatrixXd coarseW = coarseG;
        forEdges(coarse,
          [&](std::int64_t i, const Edge& edge, const double* target)
          {
            const std::int64_t from = split.lifted[i];
            const std::int64_t to = split.lifted[edge.neighbour];
            double weights = 0.0;
            double sum = 0.0;
            for (const std::int64_t j : split.retained)
            {
              const double weight = w(to, j) * w(j, from) / fine.node[j].pull;
              weights += weight;
              sum += weight * (g(j, to) + g(from, j));
            }
            EXPECT_NEAR(edge.weight, weights, 1e-14 * weights);
            EXPECT_NEAR(target[k], sum / weights, 1e-13 * largest(g));
            coarseG(i, edge.neighbour) = target[k];
          });
        EXPECT_EQ(largest(coarseG + coarseG.transpose()), 0.0) << "antisymmetric to the last bit";
      }
    });
}

TEST(Shi2006Operators, TheConstraintsAreHandedOnAsInEquation10)
{
  forSteps(true,
    [](const Level& fine, const Level& coarse)
    {
      const Eigen::MatrixXd v = rowsOf(fine.value);
      Eigen::MatrixXd xi = rowsOf(fine.constraint);
      for (std::int64_t i = 0; i < fine.nodes(); ++i)
      {
        xi.row(i) -= fine.node[i].alpha * v.row(i);
      }
      const Split split(fine);
      Eigen::MatrixXd expected = xi(split.lifted, AllIndices);
      Eigen::VectorXd alpha(coarse.nodes());
      for (std::int64_t c = 0; c < coarse.nodes(); ++c)
      {
        alpha(c) = fine.node[split.lifted[c]].alpha;
      }
      forEdges(fine,
        [&](std::int64_t i, const Edge& edge, const double* target)
        {
          if (fine.node[i].lifted())
          {
            const std::int64_t j = edge.neighbour;
            const Eigen::Map<const Eigen::RowVectorXd> d(target, fine.columns());
            const double share = edge.weight / fine.node[j].pull;
            expected.row(fine.node[i].parent) +=
              share * (xi.row(j) + fine.node[j].alpha * (d - (v.row(i) - v.row(j))));
            alpha(fine.node[i].parent) += share * fine.node[j].alpha;
          }
        });
      EXPECT_LT(largest(rowsOf(coarse.constraint) - expected), 1e-13 * largest(expected));
      for (std::int64_t c = 0; c < coarse.nodes(); ++c)
      {
        EXPECT_NEAR(coarse.node[c].alpha, alpha(c), 1e-14 * coarse.node[c].diagonal);
      }
    });
}

TEST(Shi2006Operators, ProlongationIsThatOfEquations4And5)
{
  forSteps(true,
    [](Level& fine, const Level& coarse)
    {
      const Eigen::MatrixXd v = rowsOf(fine.value);
      const Eigen::MatrixXd correction = rowsOf(coarse.value);
      ASSERT_GT(largest(correction), 1e-3);
      const Eigen::MatrixXd xi0 = rowsOf(fine.constraint);
      Eigen::MatrixXd delta(fine.nodes(), fine.columns());
      for (std::int64_t i = 0; i < fine.nodes(); ++i)
      {
        const shi2006::Node& node = fine.node[i];
        delta.row(i) = node.lifted() ? correction.row(node.parent).eval()
                                     : (xi0.row(i) - node.alpha * v.row(i)).eval();
      }
      forEdges(fine,
        [&](std::int64_t i, const Edge& edge, const double* target)
        {
          const shi2006::Node& other = fine.node[edge.neighbour];
          if (!fine.node[i].lifted() && other.lifted())
          {
            const Eigen::Map<const Eigen::RowVectorXd> d(target, fine.columns());
            delta.row(i) +=
              edge.weight * (correction.row(other.parent) + d - (v.row(i) - v.row(edge.neighbour)));
          }
        });
      for (std::int64_t i = 0; i < fine.nodes(); ++i)
      {
        delta.row(i) /= fine.node[i].lifted() ? 1.0 : fine.node[i].pull;
      }
      shi2006::prolong(coarse, fine);
      EXPECT_LT(largest(rowsOf(fine.value) - v - delta), 1e-13 * largest(v));
    });
}

TEST(Shi2006Operators, RelaxationIsGaussSeidelInStreamOrder)
{
  forHierarchies(
    [](Hierarchy& hierarchy)
    {
      hierarchy.restrictAll();
      for (Level* level : { &hierarchy.finest(), &hierarchy.next, &hierarchy.last })
      {
        const Eigen::MatrixXd a = denseMatrix(*level);
        const Eigen::MatrixXd b = rowsOf(level->rightSide);
        Eigen::MatrixXd v = rowsOf(level->value);
        const double squares = (b - a * v).squaredNorm();
        EXPECT_NEAR(shi2006::residualSquares(*level), squares, 1e-10 * b.squaredNorm());
        for (std::int64_t i = 0; i < level->nodes(); ++i)
        {
          v.row(i) += (b.row(i) - a.row(i) * v) / a(i, i);
        }
        shi2006::relax(*level);
        EXPECT_LT(largest(rowsOf(level->value) - v), 1e-13 * largest(v));
      }
    });
}

TEST(Shi2006Operators, TheFinestLevelIsTheProblem)
{
  for (const StreamMesh& mesh : { toStream(torus(24, 12, 0.3)), toStream(tetBox(6, 6, 6, 0.15)) })
  {
    ArrayProblem problem = richProblem(mesh, Weights::Uniform);
    const AssembledLevel assembled(mesh, problem);
    const Level& level = assembled.level;
    MemorySource source(mesh);
    const DirectSystem direct = assembleDirect(source, problem);
    const auto& free = direct.freeVertices;
    const Eigen::MatrixXd a = denseMatrix(level)(free, free);
    EXPECT_LT(largest(a - Eigen::MatrixXd(direct.matrix)), 1e-13 * largest(a));
    const Eigen::MatrixXd b = rowsOf(level.rightSide)(free, AllIndices);
    EXPECT_LT(largest(b - direct.rightSide), 1e-13 * largest(b));
    // Each edge has the target of the problem.
    forEdges(level,
      [&](std::int64_t i, const Edge& edge, const double* target)
      {
        double expected[3];
        problem.Target(&mesh.positions[3 * i], &mesh.positions[3 * edge.neighbour], expected);
        for (int k = 0; k < 3; ++k)
        {
          ASSERT_EQ(target[k], expected[k]);
        }
      });
    // xi0: contributions of the constrained neighbours and the source.
    EdgeWeights edges(source.info(), Weights::Uniform);
    source.rewind(1000);
    MeshBlock block;
    while (source.next(block))
    {
      edges.add(block, mesh.positions);
    }
    edges.finish(mesh.positions);
    Eigen::MatrixXd xi0 = Eigen::MatrixXd::Zero(mesh.vertices(), 3);
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      for (int k = 0; k < 3; ++k)
      {
        xi0(v, k) = problem.Prescribed[v] ? problem.Value[3 * v + k]
                                          : edges.mass()(v) * problem.Source[3 * v + k];
      }
    }
    const auto addConstrained = [&](std::int64_t i, std::int64_t j, double weight)
    {
      if (!problem.Prescribed[i] && problem.Prescribed[j])
      {
        double d[3];
        problem.Target(&mesh.positions[3 * i], &mesh.positions[3 * j], d);
        for (int k = 0; k < 3; ++k)
        {
          xi0(i, k) += weight * (problem.Value[3 * j + k] + d[k]);
        }
      }
    };
    for (const EdgeWeight& edge : edges.edges())
    {
      addConstrained(edge.from, edge.to, edge.weight);
      addConstrained(edge.to, edge.from, edge.weight);
    }
    EXPECT_LT(largest(rowsOf(level.constraint) - xi0), 1e-13 * largest(b));
  }
}

TEST(Shi2006Operators, NodesThatShareAConstrainedVertexAloneHaveNoEdge)
{
  // Two triangles with one vertex in common, which is prescribed.
  const StreamMesh mesh{ CellType::Triangle, { 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0 },
    { 0, 1, 2, 0, 3, 4 }, {}, {}, {} };
  ArrayProblem problem;
  problem.EdgeWeights = Weights::Uniform;
  problem.Prescribed = { 1, 0, 0, 0, 0 };
  problem.Value = { 4, 0, 0, 0, 0 };
  AssembledLevel assembled(mesh, problem);
  const Level coarse = assembled.coarsen(assembled.level);
  ASSERT_EQ(coarse.nodes(), 2);
  EXPECT_EQ(assembled.level.node[1].parent, 0);
  EXPECT_EQ(assembled.level.node[3].parent, 1);
  for (std::int64_t c = 0; c < 2; ++c)
  {
    EXPECT_EQ(coarse.edges.size(c), 0);
    // 1 + w alpha / Z with w = alpha = 1, Z = 2.
    EXPECT_DOUBLE_EQ(coarse.node[c].alpha, 1.5);
    EXPECT_DOUBLE_EQ(coarse.node[c].diagonal, 1.5);
  }
}

} // namespace smg::testing
