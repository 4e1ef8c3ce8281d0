// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Multigrid/Cycle/CoarsestFactor.h"

#include "Solver/Core/DisjointSets.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>

// The direct solve on the coarsest level. It has at most a thousand nodes (CoarsestNodes), or more
// where coarsening stalled, so a sparse Cholesky factorisation is cheap; it is made once and used
// by every V-cycle.
//
// Two things keep a plain factorisation from working. Components without constraint make the matrix
// singular: findFloating() and project() remove their kernel. And the weights are those of coarse
// levels, rounded to single precision or BFloat16: stiffened() restores definiteness. Adding s |w|
// to the weight w of an edge adds a positive semidefinite matrix with zero row sums, so constants
// and everything that is nearly constant along strong edges are hardly affected, while adding to
// the diagonal alone would tie free components to zero.
//
// Where flat cells have large negative weights, the removal of small entries of coarse operators
// can cost definiteness, too, of single modes of few nodes: makeDefinite() takes the magnitudes of
// their pivots. That changes the matrix by as many ranks, and the iteration pays a few steps.
//
// The order of elimination and all sums depend on the matrix alone: the factor has the same bits
// whether the coarse levels were built from windows or in core.

namespace smg
{

/** Finds the components; one floats if none of its nodes is anchored. */
void CoarsestFactor::findFloating(const CoarsestMatrix& matrix)
{
  const std::size_t nodes = matrix.diagonal.size();
  DisjointSets<std::size_t> components(nodes);
  for (const auto& entry : matrix.lower)
  {
    components.join(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(entry.col()));
  }
  std::vector<bool> anchored(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    if (matrix.anchored[i])
    {
      anchored[components.first(i)] = true;
    }
  }
  this->Floating.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    // The first node of the component is the one to be pinned.
    const std::size_t first = components.first(i);
    this->Floating[i] = anchored[first] ? -1 : static_cast<Eigen::Index>(first);
  }
}

namespace
{

/** The bytes of a factor with this number of entries, and of the matrix that it is made of. */
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
  // L L^T fails if the matrix is not definite, which tells that it needs more stiffening. An exact
  // matrix may be indefinite, which L D L^T permits.
  this->Factor.setMode(matrix.rounding > 0.0 ? Eigen::CholmodSimplicialLLt : Eigen::CholmodLDLt);
  // If that share of the weights is not enough, their rounding is not the cause.
  constexpr double MaxShare = 0x1p-12, Growth = 8.0;
  double share = matrix.rounding;
  const Eigen::SparseMatrix<double> first = this->stiffened(matrix, share);
  // The pattern does not depend on the share, so one analysis serves all attempts. It tells the
  // size of the factor before memory is taken for it.
  this->Factor.analyzePattern(first);
  this->Memory.reset();
  this->Memory.emplace(pool, factorBytes(this->Factor.cholmod().lnz, matrix));
  this->Factor.factorize(first);
  while (this->Factor.info() != Eigen::Success)
  {
    share *= Growth;
    if (!(share > 0.0 && share <= MaxShare))
    {
      this->factorizeIndefinite(matrix);
      return;
    }
    this->Factor.factorize(this->stiffened(matrix, share));
  }
}

void CoarsestFactor::factorizeIndefinite(const CoarsestMatrix& matrix)
{
  this->Factor.setMode(Eigen::CholmodLDLt);
  this->Factor.cholmod().final_ll = 0; // which the mode L L^T has set
  const Eigen::SparseMatrix<double> sparse = this->stiffened(matrix, matrix.rounding);
  this->Factor.analyzePattern(sparse);
  this->Factor.factorize(sparse);
  if (this->Factor.info() != Eigen::Success ||
      (matrix.rounding > 0.0 && !this->Factor.makeDefinite(sparse.diagonal())))
  {
    throw Error("the coarsest level's matrix could not be factorised: its weights, which come from "
                "the shapes of the cells and from the conductivity, span too many orders of "
                "magnitude");
  }
}

bool CoarsestFactor::Decomposition::makeDefinite(const Eigen::VectorXd& diagonal)
{
  // A pivot that is nearly zero says nothing of its mode: it would take all of the correction.
  constexpr double Least = 0x1p-6;
  const cholmod_factor& factor = *this->m_cholmodFactor;
  if (factor.is_ll != 0 || factor.is_super != 0 || factor.xtype != CHOLMOD_REAL)
  {
    return false;
  }
  // Of each column the first entry is the pivot.
  const auto* first = static_cast<const int*>(factor.p);
  const auto* nodes = static_cast<const int*>(factor.Perm);
  auto* values = static_cast<double*>(factor.x);
  for (std::size_t k = 0; k < factor.n; ++k)
  {
    double& pivot = values[first[k]];
    if (!(pivot > 0.0))
    {
      pivot = std::max(std::fabs(pivot), Least * std::fabs(diagonal[nodes[k]]));
    }
    if (!(pivot > 0.0 && std::isfinite(pivot)))
    {
      return false;
    }
  }
  return true;
}

/** The matrix with every edge stiffened by this share of the magnitude of its weight: a positive
 * semidefinite addition with zero row sums. */
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
    // A pinned node becomes an equation of its own, x = 0: its row and column are left out, but its
    // weights stay in the diagonals of its neighbours.
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

/** The sums run in node order. */
void CoarsestFactor::subtractMeans(Eigen::MatrixXd& values) const
{
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(values.rows());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    if (const Eigen::Index first = this->Floating[static_cast<std::size_t>(i)]; first >= 0)
    {
      sums.row(first) += values.row(i);
      counts(first) += 1.0;
    }
  }
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    if (const Eigen::Index first = this->Floating[static_cast<std::size_t>(i)]; first >= 0)
    {
      values.row(i) -= sums.row(first) / counts(first);
    }
  }
}

/** Subtracts from b its means, the part outside the range of the matrix, and sets b to zero at
 * pinned nodes. */
void CoarsestFactor::project(Eigen::MatrixXd& b) const
{
  this->subtractMeans(b);
  for (Eigen::Index i = 0; i < b.rows(); ++i)
  {
    if (this->pinned(i))
    {
      b.row(i).setZero();
    }
  }
}

/** x = A^-1 b. Floating components get one of their solutions; the others differ by a constant,
 * which does not change a residual, since the row sums are zero. */
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
