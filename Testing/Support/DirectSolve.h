// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/DirectSystem.h"

namespace smg::testing
{

/**
 * Solves the system by CHOLMOD's simplicial LDL^T and returns the solution at all vertices. On
 * floating components, the part of b outside the range of A (the mass-weighted mean of the source)
 * is omitted, and the weighted mean of the solution is that of the initial values.
 */
Eigen::MatrixXd solveDirect(const DirectSystem& system);

/** The largest difference over all entries, divided by max(expected) - min(expected). */
double relativeError(const Eigen::MatrixXd& values, const Eigen::MatrixXd& expected);

} // namespace smg::testing
