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
 * That is the Schur complement of the level's matrix without the edges between retained nodes: it
 * is symmetric to the last bit, an M-matrix, and its row sums are alpha. Nodes that share
 * constrained vertices alone have no edge. `coarse` comes empty; its state is zero.
 */
void buildCoarseOperator(const Level& fine, Level& coarse, Pool& pool);

} // namespace smg::shi2006
