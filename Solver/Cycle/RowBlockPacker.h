// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Cycle/RowBlock.h"
#include "Solver/Hierarchy/CoarseningData.h"
#include "Solver/Storage/SpareBuffers.h"

namespace smg
{

/**
 * Copies the rows [first, first + nodes) of a level, and its interpolation if `coarsening` is not
 * null, to a block whose weights are of type Weight, float or BFloat16, in one of the buffers.
 */
template <class Weight>
RowBlock packRows(SpareBuffers& buffers, const LevelRows& rows, const CoarseningData* coarsening,
  std::int64_t first, std::int64_t nodes);

} // namespace smg
