// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Report.h"

#include <cstdint>
#include <string>

namespace smg
{

/** What every process knows of a solve. */
struct SolveSummary
{
  std::string error;        ///< empty: the solve succeeded
  bool isCancelled = false; ///< whether that is no error, but what was asked for
  std::string report;
  std::string notes; ///< of the report, a line each
  int columns = 0;
  double residual = 0.0;
  int cycles = 0, passes = 0;
  bool converged = false;
  std::int64_t peakMemory = 0;

  /** Of a solve that succeeded, with `columns` values a vertex. */
  static SolveSummary of(const Report& report, int columns)
  {
    SolveSummary summary;
    summary.report = report.json();
    for (const std::string& note : report.notes)
    {
      summary.notes += (summary.notes.empty() ? "" : "\n") + note;
    }
    summary.columns = columns;
    summary.residual = report.residual();
    summary.cycles = report.cycles;
    summary.passes = report.passes;
    summary.converged = report.converged;
    summary.peakMemory = report.pool_bytes_peak;
    return summary;
  }

  /** Of a solve that failed. */
  static SolveSummary failed(const std::string& sentence)
  {
    SolveSummary summary;
    summary.error = sentence;
    return summary;
  }
};

} // namespace smg
