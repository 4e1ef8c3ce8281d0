// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/**
 * Relaxation, equation (3), one Gauss-Seidel sweep in stream order:
 *
 *   v_i = (sum_j w_ij (v_j + d_ij) + xi0_i) / (sum_j w_ij + alpha_i).
 *
 * alpha stands in the denominator on every level; the paper prints it where its sum over all
 * neighbours has it already, which is true of the finest level only. A node without edges and
 * without alpha, all that is left of a part that no constraint reaches, keeps its value.
 */
void relax(Level& level);

/** ||b - A v||^2, all columns together. */
double residualSquares(const Level& level);

} // namespace smg::shi2006
