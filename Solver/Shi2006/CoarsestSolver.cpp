// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Shi2006/CoarsestSolver.h"

#include "Solver/Core/Error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <numeric>
#include <vector>

namespace smg::shi2006
{
namespace
{

using Matrix = Eigen::SparseMatrix<double>;

/** For each node of a part without alpha the part's first node, else -1. */
std::vector<std::int64_t> findFloatingParts(const Level& level)
{
  const auto nodes = static_cast<std::size_t>(level.nodes());
  std::vector<std::int64_t> above(nodes);
  std::iota(above.begin(), above.end(), 0);
  const auto root = [&above](std::int64_t i)
  {
    while (above[static_cast<std::size_t>(i)] != i)
    {
      std::int64_t& next = above[static_cast<std::size_t>(i)];
      i = next = above[static_cast<std::size_t>(next)];
    }
    return i;
  };
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const Edge* edge = level.edges.row(i);
    for (std::int64_t e = 0; e < level.edges.size(i) && edge[e].neighbour < i; ++e)
    {
      const std::int64_t a = root(i);
      const std::int64_t b = root(edge[e].neighbour);
      above[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<bool> anchored(nodes);
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    if (level.node[i].alpha > 0.0)
    {
      anchored[static_cast<std::size_t>(root(i))] = true;
    }
  }
  std::vector<std::int64_t> floating(nodes);
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const std::int64_t first = root(i);
    floating[static_cast<std::size_t>(i)] = anchored[static_cast<std::size_t>(first)] ? -1 : first;
  }
  return floating;
}

} // namespace

struct CoarsestSolver::Implementation
{
  Eigen::CholmodSimplicialLDLT<Matrix, Eigen::Lower> factor;
  std::vector<std::int64_t> floating;

  bool pinned(std::int64_t i) const { return this->floating[static_cast<std::size_t>(i)] == i; }

  /** Takes from b the mean over each floating part, and sets it to zero at the pinned node. */
  void project(Eigen::MatrixXd& b) const
  {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(b.rows(), b.cols());
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(b.rows());
    for (Eigen::Index i = 0; i < b.rows(); ++i)
    {
      if (const auto first = this->floating[static_cast<std::size_t>(i)]; first >= 0)
      {
        sums.row(first) += b.row(i);
        counts(first) += 1.0;
      }
    }
    for (Eigen::Index i = 0; i < b.rows(); ++i)
    {
      if (const auto first = this->floating[static_cast<std::size_t>(i)]; first >= 0)
      {
        b.row(i) -= sums.row(first) / counts(first);
      }
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

void CoarsestSolver::factorize(const Level& level)
{
  if (level.nodes() == 0)
  {
    return;
  }
  this->Self->floating = findFloatingParts(level);
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::int64_t i = 0; i < level.nodes(); ++i)
  {
    const bool pinned = this->Self->pinned(i);
    triplets.emplace_back(i, i, pinned ? 1.0 : level.node[i].diagonal);
    const Edge* edge = level.edges.row(i);
    for (std::int64_t e = 0; e < level.edges.size(i) && edge[e].neighbour < i; ++e)
    {
      if (!pinned && !this->Self->pinned(edge[e].neighbour))
      {
        triplets.emplace_back(i, edge[e].neighbour, -edge[e].weight);
      }
    }
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

std::int64_t CoarsestSolver::floatingParts() const
{
  std::int64_t parts = 0;
  for (std::size_t i = 0; i < this->Self->floating.size(); ++i)
  {
    parts += this->Self->pinned(static_cast<std::int64_t>(i)) ? 1 : 0;
  }
  return parts;
}

void CoarsestSolver::solve(Level& level) const
{
  if (level.nodes() == 0)
  {
    return;
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd b =
    Eigen::Map<const RowMajor>(level.rightSide.at(0), level.nodes(), level.columns());
  this->Self->project(b);
  Eigen::Map<RowMajor>(level.value.at(0), level.nodes(), level.columns()) =
    this->Self->factor.solve(b);
}

} // namespace smg::shi2006
