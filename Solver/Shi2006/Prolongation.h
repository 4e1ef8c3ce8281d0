// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Shi2006/Level.h"

namespace smg::shi2006
{

/** Prolongation, equations (4) and (5): adds the correction of the next level to the values of the
 * lifted nodes, and its interpolation by (5) to those of the retained nodes. */
void prolong(const Level& coarse, Level& fine);

} // namespace smg::shi2006
