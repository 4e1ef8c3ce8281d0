// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"
#include "Testing/Random/Shapes.h"

#include <Eigen/Core>

#include <vector>

namespace smg::testing
{

/**
 * The answer to a case by a direct solve in double precision. Shares no code with the libraries: it
 * reads the JSON of the problem itself, evaluates places and values on the whole mesh, assembles
 * element matrices from inverse Jacobians and finds facets by a map.
 */
struct Oracle
{
  explicit Oracle(const Case& given);

  /** Why the problem is refused: an entry selects nothing. Empty: it is not. */
  std::string refusal;
  Shapes shapes;
  Eigen::MatrixXd matrix;       ///< L + S, with a row of the identity at a Dirichlet vertex
  Eigen::VectorXd mass;         ///< area or volume of the cells, lumped at the vertices
  Eigen::MatrixXd rightSide;    ///< vertices x columns
  Eigen::MatrixXd loads;        ///< the sums of the magnitudes of what adds up to rightSide
  Eigen::MatrixXd solution;     ///< vertices x columns
  std::vector<bool> determined; ///< whether the equations determine the value of a vertex
  std::vector<Eigen::Matrix3d> conductivity; ///< of each cell
};

} // namespace smg::testing
