// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Benchmarks/Shi2006/EdgeOperators.h"
#include "Testing/Benchmarks/Shi2006/Shi2006.h"
#include "Testing/Solver/SolveTesting.h"

#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace smg::testing
{

/** As solveMesh(), with the equations of the paper. */
inline Solved solveByPaper(
  const StreamMesh& mesh, Problem& problem, const SolveOptions& options, std::int64_t block = 1000)
{
  MemorySource source(mesh, block);
  Shi2006 solution(problem.columns(), options);
  solution.solve(source, problem);
  return { valuesOf(solution), solution.report() };
}

/** A value at a point of the mesh, `column` by column. */
using PointFunction = double (*)(const double* p, int column);

/** A strongly nonlinear function. */
inline double wavy(const double* p, int column)
{
  return std::sin(2.0 * p[0] + column) + p[1] * p[2] + 0.3 * p[column % 3];
}

/** Edge targets that are the differences of `u` at the ends. */
inline ArrayProblem::EdgeTarget differencesOf(PointFunction u, int columns)
{
  return [=](const double* p, const double* q, double* target)
  {
    for (int k = 0; k < columns; ++k)
    {
      target[k] = u(p, k) - u(q, k);
    }
  };
}

/** Non-integrable edge targets, as in a deformation: the edge, scaled by the mean of a scale at its
 * ends. */
inline ArrayProblem::EdgeTarget scaledEdges(int columns)
{
  return [columns](const double* p, const double* q, double* target)
  {
    for (int k = 0; k < columns; ++k)
    {
      target[k] = (1.0 + 0.5 * (wavy(p, k) + wavy(q, k))) * (p[k % 3] - q[k % 3]);
    }
  };
}

/** heldEnds() with the values of `u`, which may or may not match the targets. */
inline ArrayProblem heldEndsOf(
  const StreamMesh& mesh, PointFunction u, int columns, Weights weights)
{
  ArrayProblem problem = heldEnds(mesh, columns, weights);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    for (int k = 0; k < columns; ++k)
    {
      problem.Value[columns * v + k] = problem.Prescribed[v] ? u(&mesh.positions[3 * v], k) : 0.0;
    }
  }
  return problem;
}

/** The finest level of a problem on a mesh. */
struct AssembledLevel
{
  AssembledLevel(const StreamMesh& mesh, Problem& problem)
    : components(problem.columns())
    , level(pool, problem.columns())
  {
    MemorySource source(mesh, 50);
    shi2006::FinestRows rows(
      this->pool, source.info(), problem, this->components, this->labels, this->level);
    MeshBlock block;
    while (source.next(block))
    {
      rows.add(block);
    }
    rows.finish();
    shi2006::sumRightSide(this->level);
  }

  /** Lifts `fine` and builds the next level. */
  shi2006::Level coarsen(shi2006::Level& fine)
  {
    shi2006::lift(fine);
    shi2006::Level coarse(this->pool, fine.columns());
    shi2006::buildCoarseOperator(fine, coarse, this->pool);
    return coarse;
  }

  Pool pool{ std::int64_t(1) << 32 };
  Components components;
  ComponentLabels labels{ components };
  shi2006::Level level;
};

/** Calls f(i, edge, its target). */
void forEdges(const shi2006::Level& level, const auto& f)
{
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    for (std::int64_t e = 0; e < level.edges.size(i); ++e)
    {
      f(i, level.edges.row(i)[e], level.target.at(level.edges.start(i) + e));
    }
  }
}

inline bool bothRetained(const shi2006::Level& level, std::int64_t i, std::int64_t j)
{
  return !level.node[i].lifted() && !level.node[j].lifted();
}

/** The matrix of the level; `truncated`: without the edges between retained nodes. */
inline Eigen::MatrixXd denseMatrix(const shi2006::Level& level, bool truncated = false)
{
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(level.nodes(), level.nodes());
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    a(i, i) = level.node[i].alpha;
  }
  forEdges(level,
    [&](std::int64_t i, const shi2006::Edge& edge, const double*)
    {
      if (!truncated || !bothRetained(level, i, edge.neighbour))
      {
        a(i, i) += edge.weight;
        a(i, edge.neighbour) -= edge.weight;
      }
    });
  return a;
}

/** A row of values for each node. */
inline Eigen::MatrixXd rowsOf(const Ring<double>& ring)
{
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
    ring.at(0), ring.end(), ring.lanes());
}

/** The residual of equation (2): xi_i + sum_j w_ij g_ij; `truncated` as above. */
inline Eigen::MatrixXd denseResidual(const shi2006::Level& level, bool truncated)
{
  const Eigen::MatrixXd v = rowsOf(level.value);
  Eigen::MatrixXd r = rowsOf(level.constraint);
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    r.row(i) -= level.node[i].alpha * v.row(i);
  }
  forEdges(level,
    [&](std::int64_t i, const shi2006::Edge& edge, const double* target)
    {
      if (!truncated || !bothRetained(level, i, edge.neighbour))
      {
        const Eigen::Map<const Eigen::RowVectorXd> d(target, level.columns());
        r.row(i) += edge.weight * (d - (v.row(i) - v.row(edge.neighbour)));
      }
    });
  return r;
}

/** Lifted and retained nodes of a level. */
struct Split
{
  explicit Split(const shi2006::Level& level)
  {
    for (std::int64_t i = 0; i < level.nodes(); ++i)
    {
      (level.node[i].lifted() ? this->lifted : this->retained).push_back(i);
    }
  }
  std::vector<std::int64_t> lifted, retained;
};

} // namespace smg::testing
