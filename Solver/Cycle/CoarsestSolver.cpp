// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Cycle/CoarsestSolver.h"

#include "Solver/Core/Error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cfloat>
#include <cmath>
#include <numeric>
#include <vector>

namespace smg
{
namespace
{

using Matrix = Eigen::SparseMatrix<double>;

/** Rows of the level as triplets, and the row sums. */
struct Assembled
{
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<double> diagonal, rowSum, terms; // terms: sum of the magnitudes of a row
};

Assembled assemble(LevelWindow<float>& level)
{
  Assembled result;
  const auto nodes = static_cast<std::size_t>(level.nodes());
  result.diagonal.resize(nodes);
  result.rowSum.resize(nodes);
  result.terms.resize(nodes);
  level.forRange(0, level.nodes(), level.up(),
    [&](const auto& h, const auto& a, BlockRange range, float*, float*)
    {
      for (std::int64_t k = range.begin; k < range.end; ++k)
      {
        const std::int64_t i = h.first + k;
        double sum = a.diagonal[k];
        double terms = a.diagonal[k];
        const BlockRange row = entriesOf(h, a, k);
        for (std::int64_t e = row.begin; e < row.end; ++e)
        {
          sum -= a.weight[e];
          terms += std::fabs(a.weight[e]);
          result.triplets.emplace_back(i, i + a.delta[e], -static_cast<double>(a.weight[e]));
        }
        result.diagonal[static_cast<std::size_t>(i)] = a.diagonal[k];
        result.rowSum[static_cast<std::size_t>(i)] = sum;
        result.terms[static_cast<std::size_t>(i)] = terms;
      }
    });
  return result;
}

/** For each node of a component whose row sums are all zero the component's first node, else -1. */
std::vector<int> floatingComponents(const Assembled& rows)
{
  const std::size_t nodes = rows.diagonal.size();
  std::vector<int> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int i)
  {
    while (parent[static_cast<std::size_t>(i)] != i)
    {
      int& above = parent[static_cast<std::size_t>(i)];
      i = above = parent[static_cast<std::size_t>(above)];
    }
    return i;
  };
  for (const auto& t : rows.triplets)
  {
    const int a = root(static_cast<int>(t.row()));
    const int b = root(static_cast<int>(t.col()));
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<bool> anchored(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    // Row sums of a free component are exact zeros up to the rounding of this very sum.
    if (std::fabs(rows.rowSum[i]) > 8.0 * DBL_EPSILON * rows.terms[i])
    {
      anchored[static_cast<std::size_t>(root(static_cast<int>(i)))] = true;
    }
  }
  std::vector<int> floating(nodes, -1);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    const int first = root(static_cast<int>(i));
    floating[i] = anchored[static_cast<std::size_t>(first)] ? -1 : first;
  }
  return floating;
}

} // namespace

struct CoarsestSolver::Implementation
{
  Eigen::CholmodSimplicialLDLT<Matrix, Eigen::Lower> factor;
  std::vector<int> floating;

  bool pinned(Eigen::Index i) const { return this->floating[static_cast<std::size_t>(i)] == i; }

  /** Takes from b the mean over each floating component, and sets it to zero at the pinned node. */
  void project(Eigen::MatrixXd& b) const
  {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(b.rows(), b.cols());
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(b.rows());
    for (Eigen::Index i = 0; i < b.rows(); ++i)
    {
      if (const int first = this->floating[static_cast<std::size_t>(i)]; first >= 0)
      {
        sums.row(first) += b.row(i);
        counts(first) += 1.0;
      }
    }
    for (Eigen::Index i = 0; i < b.rows(); ++i)
    {
      if (const int first = this->floating[static_cast<std::size_t>(i)]; first >= 0)
      {
        b.row(i) -= sums.row(first) / counts(first);
      }
    }
    for (Eigen::Index i = 0; i < b.rows(); ++i)
    {
      if (this->pinned(i))
      {
        b.row(i).setZero();
      }
    }
  }
};

CoarsestSolver::CoarsestSolver()
  : Self(std::make_unique<Implementation>())
{
}

CoarsestSolver::~CoarsestSolver() = default;
CoarsestSolver::CoarsestSolver(CoarsestSolver&& other) noexcept = default;
CoarsestSolver& CoarsestSolver::operator=(CoarsestSolver&& other) noexcept = default;

void CoarsestSolver::factorize(LevelWindow<float>& level)
{
  if (level.nodes() == 0)
  {
    return;
  }
  const Assembled rows = assemble(level);
  this->Self->floating = floatingComponents(rows);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(rows.triplets.size() + rows.diagonal.size());
  for (const auto& t : rows.triplets)
  {
    const bool pinned = this->Self->pinned(t.row()) || this->Self->pinned(t.col());
    if (t.row() > t.col() && !pinned)
    {
      triplets.push_back(t);
    }
  }
  for (std::size_t i = 0; i < rows.diagonal.size(); ++i)
  {
    triplets.emplace_back(
      i, i, this->Self->pinned(static_cast<Eigen::Index>(i)) ? 1.0 : rows.diagonal[i]);
  }
  Matrix matrix(level.nodes(), level.nodes());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  this->Self->factor.compute(matrix);
  if (this->Self->factor.info() != Eigen::Success)
  {
    throw Error(
      "the coarsest level's matrix could not be factorised: the weights of the mesh span too "
      "many orders of magnitude; use uniform weights");
  }
}

void CoarsestSolver::solve(LevelWindow<float>& level) const
{
  const int stride = level.stride();
  const auto nodes = static_cast<Eigen::Index>(level.nodes());
  if (nodes == 0)
  {
    return;
  }
  Eigen::MatrixXd b(nodes, stride);
  for (Eigen::Index i = 0; i < nodes; ++i)
  {
    const float* from = level.b().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      b(i, lane) = from[lane];
    }
  }
  this->Self->project(b);
  const Eigen::MatrixXd x = this->Self->factor.solve(b);
  for (Eigen::Index i = 0; i < nodes; ++i)
  {
    float* to = level.x().at(i);
    for (int lane = 0; lane < stride; ++lane)
    {
      to[lane] = static_cast<float>(x(i, lane));
    }
  }
}

} // namespace smg
