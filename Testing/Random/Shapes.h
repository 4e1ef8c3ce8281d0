// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"

#include <Eigen/Core>

#include <vector>

namespace smg::testing
{

/** The basis functions of the cells of a case, without area or volume where they have no weight. */
struct Shapes
{
  explicit Shapes(const Case& given);

  std::vector<Eigen::MatrixXd> gradients; ///< of each cell: corners x 3; empty: without weight
  Eigen::VectorXd measure;                ///< of each cell
};

} // namespace smg::testing
