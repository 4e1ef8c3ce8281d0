// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Benchmarks/Shi2006/Level.h"

namespace smg::shi2006
{

/**
 * The lifting rule: a greedy maximal independent set in stream order. Node i is lifted (a C-point)
 * if no neighbour before it is, otherwise retained (an F-point). A node without edges is retained:
 * relaxation solves it exactly. Sets `parent` and `pull` of the nodes of the level; returns the
 * number of lifted nodes.
 */
std::int64_t lift(Level& level);

} // namespace smg::shi2006

namespace smg::shi2006
{

/** Prolongation, equations (4) and (5): adds the correction of the next level to the values of the
 * lifted nodes, and interpolates the values of the retained nodes by (5). */
void prolong(const Level& coarse, Level& fine);

} // namespace smg::shi2006

namespace smg::shi2006
{

/**
 * The coarse operator, equations (7) and (9): weights and alpha of the next level, given a level
 * whose nodes have been lifted or retained. For lifted i and k, over retained j,
 *
 *   w_ki = sum_j w_kj w_ji / Z_j,   alpha_i += sum_j w_ji alpha_j / Z_j.
 *
 * This is the Schur complement of the matrix of the level without the edges between retained nodes:
 * it is exactly symmetric, an M-matrix, and its row sums are alpha. Nodes that share only
 * constrained vertices have no edge. `coarse` must be empty; its values and right-hand sides become
 * zero.
 */
void buildCoarseOperator(const Level& fine, Level& coarse, Pool& pool);

} // namespace smg::shi2006

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
