// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

#include <cstdint>
#include <string>

namespace smg
{

/** The summary of a solve, known to every process. */
struct SolveSummary
{
  std::string error;        ///< empty: the solve succeeded
  bool isCancelled = false; ///< whether the error is a requested cancellation
  std::string report;
  std::string notes; ///< of the report, one per line
  /** Of a solve on a preview: the points of that and of the mesh; 0 of others. */
  std::int64_t previewPoints = 0, fullPoints = 0;
  int columns = 0;
  double residual = 0.0;
  int cycles = 0, passes = 0;
  int processes = 0; ///< of the distributed engine, whose iterations `cycles` counts; 0: none
  bool converged = false;
  std::int64_t peakMemory = 0;

  /** The summary of a successful solve, with `columns` values per vertex. */
  static SolveSummary of(const Report& report, int columns);
  /** The summary of a failed solve. */
  static SolveSummary failed(const std::string& sentence);

  /** The outcome in one line; empty before a solve. */
  std::string outcome() const;
};

} // namespace smg
