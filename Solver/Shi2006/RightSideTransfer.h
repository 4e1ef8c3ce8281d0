// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/**
 * Restriction, equations (8) and (10): computes the equation of the next level, whose values become
 * zero, from the remainders of the equation of the level for its current values, g_ij = d_ij - (v_i
 * - v_j) and xi_i = xi0_i - alpha_i v_i. For lifted i and k, over retained j,
 *
 *   g_ki = sum_j w_kj w_ji (g_kj + g_ji) / Z_j / w_ki,
 *   xi_i += sum_j w_ji (xi_j + alpha_j g_ji) / Z_j.
 *
 * g must be antisymmetric, and the result is. The flux over the edges between retained nodes is
 * omitted, as in the coarse operator: this is the right-hand side of the truncated system, not P^T
 * r, and the only one consistent with that operator.
 */
void restrictRightSide(const Level& fine, Level& coarse);

/** b_i = xi0_i + sum_j w_ij d_ij: the part of (3) that relaxation does not change. */
void sumRightSide(Level& level);

} // namespace smg::shi2006
