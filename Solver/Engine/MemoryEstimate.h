// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <cstdint>

namespace smg
{

/**
 * Bytes of the pool that a solve will need at least, from the stream's statistics: out of core the
 * windows of all levels hold a number of nodes proportional to the stream's span; in core
 * everything stays, and `furtherCoreBytes` more a vertex. 0 when the span is not known.
 */
SMG_EXPORT std::int64_t estimateMemory(const StreamInfo& info, const Problem& problem,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

} // namespace smg
