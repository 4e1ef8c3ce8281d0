// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Pool.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cstdint>
#include <optional>
#include <vector>

namespace smg
{

/** The symmetric matrix of the coarsest level. */
struct CoarsestMatrix
{
  std::vector<Eigen::Triplet<double>> lower; ///< entries below the diagonal
  std::vector<double> diagonal;
  std::vector<bool> anchored; ///< per node: whether its row sum differs from zero
  double rounding = 0.0;      ///< relative error of the entries below the diagonal
};

/**
 * The Cholesky factor of the matrix of the coarsest level, by CHOLMOD. A component without an
 * anchored node determines its solution only up to a constant: its first node is pinned to zero,
 * and the mean of its right-hand side is subtracted.
 *
 * An exact matrix, definite or not, is factorised as L D L^T. Rounding of the entries may destroy
 * the small eigenvalues of modes that only slivers resist, so that the matrix is barely definite or
 * indefinite. Where entries are rounded, every edge is therefore stiffened by about that rounding,
 * which hardly affects weakly constrained modes, and by more until the matrix is definite, and the
 * result is factorised as L L^T. If that does not help, it is factorised as L D L^T, with the
 * magnitudes of the pivots in D.
 */
class CoarsestFactor
{
public:
  /** Factorises the matrix. The pool accounts for the factor from its analysis on. Throws Error
   * above the memory limit, or if a pivot is zero or not finite. */
  void factorize(const CoarsestMatrix& matrix, Pool& pool);
  /** Solves for each column of b. */
  Eigen::MatrixXd solve(Eigen::MatrixXd b) const;
  /** Subtracts the mean of each column over each component without an anchored node. */
  void subtractMeans(Eigen::MatrixXd& values) const;
  /** The number of components without an anchored node. */
  std::int64_t floatingComponents() const;

private:
  class Decomposition
    : public Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>
  {
  public:
    /** Makes the pivots of L D L^T positive, given the diagonal of the matrix. Returns whether that
     * was possible. */
    bool makeDefinite(const Eigen::VectorXd& diagonal);
  };

  void factorizeIndefinite(const CoarsestMatrix& matrix);
  void findFloating(const CoarsestMatrix& matrix);
  Eigen::SparseMatrix<double> stiffened(const CoarsestMatrix& matrix, double share) const;
  void project(Eigen::MatrixXd& b) const;
  bool pinned(Eigen::Index i) const { return this->Floating[static_cast<std::size_t>(i)] == i; }

  std::optional<Reservation> Memory;
  Decomposition Factor;
  std::vector<Eigen::Index> Floating; // per node: the first node of its component, -1 if anchored
};

} // namespace smg
