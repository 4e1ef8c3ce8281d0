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
 * alpha is part of the denominator on every level; in the paper the sum over all neighbours already
 * contains it, which holds on the finest level only. A node without edges and without alpha, the
 * remainder of an unconstrained part, keeps its value.
 */
void relax(Level& level);

/** ||b - A v||^2 over all columns. */
double residualSquares(const Level& level);

} // namespace smg::shi2006
