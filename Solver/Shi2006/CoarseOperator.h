// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/**
 * The coarse operator, equations (7) and (9): weights and alpha of the next level of a level whose
 * nodes have been lifted or retained. For lifted i and k, over retained j,
 *
 *   w_ki = sum_j w_kj w_ji / Z_j,   alpha_i += sum_j w_ji alpha_j / Z_j.
 *
 * This is the Schur complement of the matrix of the level without the edges between retained nodes:
 * it is exactly symmetric, an M-matrix, and its row sums are alpha. Nodes that share only
 * constrained vertices have no edge. `coarse` must be empty; its state becomes zero.
 */
void buildCoarseOperator(const Level& fine, Level& coarse, Pool& pool);

} // namespace smg::shi2006
