// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <cstdint>

namespace smg
{

/**
 * The minimum bytes of the pool for a solve, from the statistics of the stream: out of core the
 * windows of all levels hold a number of nodes proportional to the stream's span; in core
 * everything stays, with `furtherCoreBytes` more per vertex. 0 if the span is unknown.
 */
SMG_EXPORT std::int64_t estimateMemory(const StreamInfo& info, const Problem& problem,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

/** The bytes that such a solve is expected to need: more than the minimum, which never refuses a
 * solve that fits. */
SMG_EXPORT std::int64_t expectedMemory(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options);

/** Whether the memory limit leaves room for several tasks per level in the first pass, each some
 * nodes behind the one before it; whatever the number of threads is. */
SMG_EXPORT bool permitsTasks(
  const StreamInfo& info, const Problem& problem, const SolveOptions& options);

} // namespace smg
