// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace smg
{

/** A symmetric matrix of the coarsest level. */
struct CoarsestMatrix
{
  std::vector<Eigen::Triplet<double>> lower; ///< entries below the diagonal
  std::vector<double> diagonal;
  std::vector<bool> anchored; ///< a node: its row does not sum to zero
  double rounding = 0.0;      ///< what share of itself an entry below the diagonal may be off
};

/**
 * The Cholesky factor of the coarsest level's matrix. A component of it none of whose nodes is
 * anchored determines its solution up to a constant only: its first node is pinned to zero, and its
 * right-hand side loses its mean.
 *
 * The factor of an exact matrix is its L D L^T, be it definite or not. Of one whose entries are
 * rounded, it may be lost what slivers resist hardly at all, so that it is barely or not definite
 * any more. Then every edge is made stiffer by about that rounding, which leaves alone the level of
 * what little holds, and where that does not make it definite, by more: L L^T is its factor.
 */
class CoarsestFactor
{
public:
  /** Throws Error if a pivot of an exact matrix is zero, or a rounded one far from definite. */
  void factorize(const CoarsestMatrix& matrix);
  /** Solves for a right-hand side a column. */
  Eigen::MatrixXd solve(Eigen::MatrixXd b) const;
  /** Components that are not anchored. */
  std::int64_t floatingComponents() const;

private:
  void findFloating(const CoarsestMatrix& matrix);
  Eigen::SparseMatrix<double> stiffened(const CoarsestMatrix& matrix, double share) const;
  bool pinned(Eigen::Index i) const { return this->Floating[static_cast<std::size_t>(i)] == i; }
  void project(Eigen::MatrixXd& b) const;

  Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> Factor;
  std::vector<Eigen::Index> Floating; // a node: the first one of its component, -1 if anchored
};

} // namespace smg
