// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/**
 * The lifting rule: a greedy maximal independent set in stream order. Node i is lifted iff no lower
 * neighbour is. A node without edges is retained: relaxation solves it exactly. Sets `parent` and
 * `pull` of the nodes of the level; returns the number of lifted nodes.
 */
std::int64_t lift(Level& level);

} // namespace smg::shi2006
