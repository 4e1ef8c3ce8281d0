// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Multigrid/Cycle/RowBlock.h"
#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "smg/Export.h"

namespace smg
{

/** Packs the rows [first, first + nodes) of a level into a block in one of the buffers, with
 * their interpolation and patches if `coarsening` is not null. The weights are floats, or
 * BFloat16 if `mayRound`, no node is special and no row is stiff. */
SMG_EXPORT RowBlock packRows(SpareBuffers& buffers, const LevelRows& rows,
  const CoarseningData* coarsening, std::int64_t first, std::int64_t nodes, bool mayRound);

} // namespace smg
