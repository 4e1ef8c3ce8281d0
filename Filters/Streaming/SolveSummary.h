// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

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
  static SolveSummary of(const Report& report, int columns);
  /** Of a solve that failed. */
  static SolveSummary failed(const std::string& sentence);

  /** In a line; empty before a solve. */
  std::string outcome() const;
};

} // namespace smg
