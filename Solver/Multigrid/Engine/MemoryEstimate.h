// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Solve.h"

#include <cstdint>

namespace smg
{

/** A lower bound of the bytes of the pool for a solve, from the statistics of the stream. Out of
 * core the windows of all levels have a number of nodes proportional to the span of the stream;
 * in core everything stays, with `furtherCoreBytes` more per vertex. 0 if the span is unknown. */
SMG_EXPORT std::int64_t leastMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

/** The bytes that such a solve is expected to need: more than the lower bound, which must not
 * refuse a solve that fits. */
SMG_EXPORT std::int64_t expectedMemory(
  const StreamInfo& info, int columns, Weights weights, const SolveOptions& options);

/** Throws MemoryLimitError, with the bytes that suffice, if the memory limit is certainly too low
 * for a solve: to be called before any work. */
SMG_EXPORT void requireMemory(const StreamInfo& info, int columns, Weights weights,
  const SolveOptions& options, std::int64_t furtherCoreBytes = 0);

/** Whether the memory limit leaves room for several tasks per level in the first pass, each some
 * nodes behind the one before it; if the span is unknown, for any span; false if the number of
 * vertices is unknown. It does not depend on the number of threads, since the choice
 * of acceleration, and with it the solution, depends on the answer (see Iteration). */
SMG_EXPORT bool permitsTasks(
  const StreamInfo& info, const Problem& problem, const SolveOptions& options);

} // namespace smg
