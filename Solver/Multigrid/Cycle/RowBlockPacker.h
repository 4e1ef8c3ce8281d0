// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

namespace smg
{

/**
 * Copies the rows [first, first + nodes) of a level, and its interpolation and patches if
 * `coarsening` is not null, to a block in one of the buffers. Its weights are floats, or BFloat16
 * if `mayRound` and no row is special.
 */
SMG_EXPORT RowBlock packRows(SpareBuffers& buffers, const LevelRows& rows,
  const CoarseningData* coarsening, std::int64_t first, std::int64_t nodes, bool mayRound);

} // namespace smg
