// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/CoarsestFactor.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smg
{

void CoarsestFactor::findFloating(const CoarsestMatrix& matrix)
{
  const std::size_t nodes = matrix.diagonal.size();
  std::vector<Eigen::Index> above(nodes);
  std::iota(above.begin(), above.end(), 0);
  const auto root = [&above](Eigen::Index i)
  {
    while (above[static_cast<std::size_t>(i)] != i)
    {
      Eigen::Index& next = above[static_cast<std::size_t>(i)];
      i = next = above[static_cast<std::size_t>(next)];
    }
    return i;
  };
  for (const auto& entry : matrix.lower)
  {
    const Eigen::Index a = root(entry.row());
    const Eigen::Index b = root(entry.col());
    above[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<bool> anchored(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    if (matrix.anchored[i])
    {
      anchored[static_cast<std::size_t>(root(static_cast<Eigen::Index>(i)))] = true;
    }
  }
  this->Floating.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    const Eigen::Index first = root(static_cast<Eigen::Index>(i));
    this->Floating[i] = anchored[static_cast<std::size_t>(first)] ? -1 : first;
  }
}

namespace
{

/** Bytes of a factor with so many entries, and of the matrix that it is made of. */
std::int64_t factorBytes(double entries, const CoarsestMatrix& matrix)
{
  constexpr double EntryBytes = sizeof(double) + sizeof(int);
  constexpr double MatrixBytes = 2 * sizeof(Eigen::Triplet<double>) + EntryBytes, NodeBytes = 64;
  const auto nodes = static_cast<double>(matrix.diagonal.size());
  return static_cast<std::int64_t>(EntryBytes * entries + NodeBytes * nodes +
                                   MatrixBytes * static_cast<double>(matrix.lower.size()));
}

} // namespace

void CoarsestFactor::factorize(const CoarsestMatrix& matrix, Pool& pool)
{
  this->findFloating(matrix);
  if (matrix.diagonal.empty())
  {
    return;
  }
  this->Factor.cholmod().print = 0; // failures are expected and handled
  this->Factor.setMode(matrix.rounding > 0.0 ? Eigen::CholmodSimplicialLLt : Eigen::CholmodLDLt);
  constexpr double MaxShare = 0x1p-4, Growth = 8.0;
  double share = matrix.rounding;
  const Eigen::SparseMatrix<double> first = this->stiffened(matrix, share);
  this->Factor.analyzePattern(first);
  this->Memory.reset();
  this->Memory.emplace(pool, factorBytes(this->Factor.cholmod().lnz, matrix));
  this->Factor.factorize(first);
  while (this->Factor.info() != Eigen::Success)
  {
    share *= Growth;
    if (!(share > 0.0 && share <= MaxShare))
    {
      throw Error(
        "the coarsest level's matrix could not be factorised: the weights of the mesh span too "
        "many orders of magnitude; use uniform weights");
    }
    this->Factor.factorize(this->stiffened(matrix, share));
  }
}

/** The matrix with every edge stiffened by this share of the magnitude of its weight. */
Eigen::SparseMatrix<double> CoarsestFactor::stiffened(
  const CoarsestMatrix& matrix, double share) const
{
  const auto nodes = static_cast<Eigen::Index>(matrix.diagonal.size());
  std::vector<double> diagonal = matrix.diagonal;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(matrix.lower.size() + matrix.diagonal.size());
  for (const auto& entry : matrix.lower)
  {
    const double more = share * std::fabs(entry.value());
    diagonal[static_cast<std::size_t>(entry.row())] += more;
    diagonal[static_cast<std::size_t>(entry.col())] += more;
    if (!this->pinned(entry.row()) && !this->pinned(entry.col()))
    {
      triplets.emplace_back(entry.row(), entry.col(), entry.value() - more);
    }
  }
  for (Eigen::Index i = 0; i < nodes; ++i)
  {
    triplets.emplace_back(i, i, this->pinned(i) ? 1.0 : diagonal[static_cast<std::size_t>(i)]);
  }
  Eigen::SparseMatrix<double> sparse(nodes, nodes);
  sparse.setFromTriplets(triplets.begin(), triplets.end());
  return sparse;
}

/**
 * Subtracts the mean over each floating component from b, and sets b to zero at the pinned node.
 */
void CoarsestFactor::project(Eigen::MatrixXd& b) const
{
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(b.rows(), b.cols());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(b.rows());
  for (Eigen::Index i = 0; i < b.rows(); ++i)
  {
    if (const Eigen::Index first = this->Floating[static_cast<std::size_t>(i)]; first >= 0)
    {
      sums.row(first) += b.row(i);
      counts(first) += 1.0;
    }
  }
  for (Eigen::Index i = 0; i < b.rows(); ++i)
  {
    if (this->pinned(i))
    {
      b.row(i).setZero();
    }
    else if (const Eigen::Index first = this->Floating[static_cast<std::size_t>(i)]; first >= 0)
    {
      b.row(i) -= sums.row(first) / counts(first);
    }
  }
}

Eigen::MatrixXd CoarsestFactor::solve(Eigen::MatrixXd b) const
{
  if (b.rows() == 0)
  {
    return b;
  }
  this->project(b);
  return this->Factor.solve(b);
}

std::int64_t CoarsestFactor::floatingComponents() const
{
  std::int64_t components = 0;
  for (std::size_t i = 0; i < this->Floating.size(); ++i)
  {
    components += this->pinned(static_cast<Eigen::Index>(i)) ? 1 : 0;
  }
  return components;
}

} // namespace smg
