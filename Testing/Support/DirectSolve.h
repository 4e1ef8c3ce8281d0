// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/DirectSystem.h"

namespace smg::testing
{

/**
 * Solves the system by CHOLMOD's simplicial LDL^T; the result is given at all vertices. In a
 * component that floats, the part of b that no x can answer (the mean of the source, weighted with
 * the masses) is left out, and the solution's weighted mean is that of the initial values.
 */
Eigen::MatrixXd solveDirect(const DirectSystem& system);

/** The largest difference over all entries, divided by max(expected) - min(expected). */
double relativeError(const Eigen::MatrixXd& values, const Eigen::MatrixXd& expected);

} // namespace smg::testing
