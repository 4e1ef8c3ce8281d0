// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/ElementProblem.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace smg::testing
{

/**
 * The system (L + S) u = F of linear finite elements in Problem.h, at all vertices, assembled from
 * the data of an ElementProblem in memory and in double precision: element matrices from the
 * inverse of the Jacobian, boundary facets from a map of all facets. Does not call cells() and
 * facets() of the problem.
 */
struct DirectElements
{
  explicit DirectElements(const ElementProblem& problem);

  /** A boundary facet: its corners, in ascending order, and its length or area. */
  struct Facet
  {
    std::vector<std::int64_t> corners;
    double area;
  };

  Eigen::SparseMatrix<double> matrix, stiffness; ///< L + S, L
  Eigen::MatrixXd rightSide;                     ///< vertices x columns
  Eigen::VectorXd mass, screening;               ///< lumped; screening: from s alone
  Eigen::MatrixXd source;                        ///< lumped
  std::vector<Facet> boundary;

  /**
   * The solution with the Dirichlet values of the problem. For a singular matrix without a
   * Dirichlet condition, the mean of the right-hand side is subtracted, and the solution has the
   * mean of the initial values. For connected meshes.
   */
  Eigen::MatrixXd solve() const;

private:
  void addCell(std::int64_t cell);
  void addBoundary();

  const ElementProblem& Given;
  std::vector<Eigen::Triplet<double>> StiffnessEntries;
};

} // namespace smg::testing
