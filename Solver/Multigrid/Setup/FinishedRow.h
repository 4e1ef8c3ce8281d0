// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Setup/CoarseningData.h"
#include "Solver/Multigrid/Setup/RowBatch.h"
#include "smg/Export.h"

#include <cstdint>

namespace smg
{

/**
 * Appends coarse row c, all of whose neighbours have been sparsified, to `out`, with the last of
 * its children. Its upper weights are copied to the lower parts of the rows above it: to the next
 * entry of each, since rows are finished in order.
 */
SMG_EXPORT void finishRow(
  CoarseningData& data, std::int64_t c, std::int64_t lastChild, RowBatch& out);

} // namespace smg
