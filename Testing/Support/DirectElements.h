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
 * The system (L + S) u = F of linear finite elements that Problem.h describes, at all vertices,
 * assembled from the data of an ElementProblem in memory and in double precision: element matrices
 * from the inverse of the Jacobian, boundary facets from a map of all. The problem's own cells()
 * and facets() are not asked.
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
  Eigen::VectorXd mass, screening;               ///< lumped; screening: of s alone
  Eigen::MatrixXd source;                        ///< lumped
  std::vector<Facet> boundary;

  /** The solution: u given where the problem says so. Without a Dirichlet condition and with a
   * singular matrix that with the mean of the initial values, of a right-hand side without the
   * mean. For connected meshes. */
  Eigen::MatrixXd solve() const;

private:
  void addCell(std::int64_t cell);
  void addBoundary();

  const ElementProblem& Given;
  std::vector<Eigen::Triplet<double>> StiffnessEntries;
};

} // namespace smg::testing
