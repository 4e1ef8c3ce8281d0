// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/ElementProblem.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>

namespace smg::testing
{

/** What a report has, up to the rounding of a double. */
struct ExactResults
{
  double energy = 0.0;
  std::map<std::string, double> flux; ///< of each condition
  /** Of each part: the means of the gradient and of the flux. */
  std::map<std::string, std::array<Eigen::Vector3d, 2>> parts;
};

/** Linear finite elements for a problem of one column with scalar conductivities, parts, Dirichlet
 * and Robin conditions, assembled and solved in quadruple precision. For hundreds of vertices. */
ExactResults solveInQuadruple(const ElementProblem& problem);

} // namespace smg::testing
