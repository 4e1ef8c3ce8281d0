// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** The summary of a solve, known to every process. */
struct SolveSummary
{
  std::string error;        ///< empty: the solve succeeded
  bool isCancelled = false; ///< whether the error is a requested cancellation
  std::string report;       ///< as JSON
  std::string notes;        ///< of the report, one per line
  Report facts; ///< without what only the process that solved tells: see SolutionExchange::share()
  /** Where a preview is shown: the points of the whole mesh; else 0. */
  std::int64_t fullPoints = 0;
  /** Of a solve on the preview: its points; 0 of others. */
  std::int64_t previewPoints = 0;
  std::string previewError; ///< of a solve on the preview: how far off it may be; "": unknown
  int columns = 0;

  /** The summary of a successful solve, with `columns` values per vertex. */
  static SolveSummary of(const Report& report, int columns);
  /** The summary of a failed solve. */
  static SolveSummary failed(const std::string& sentence);

  /** The outcome in one line; empty before a solve. */
  std::string outcome() const;
  /** Where a preview is shown: whether that or the whole mesh was solved on, in a sentence; else
   * empty. `gap`: between that and how far off it may be. */
  std::string where(char gap = ' ') const;
};

/** The beginning of a note on points of an input that are corners of no cell, as "2 points are
 * corners of no triangle or polygon". */
std::string noteOnLoose(std::int64_t points, bool isSurface);

/**
 * Reads the values of the vertices `ids`, in any order, to `values` (solution.columns() each), in
 * few calls in ascending order of the solution. Throws Error if an id is not one of its vertices.
 */
void readValues(Solution& solution, std::span<const std::int64_t> ids, std::span<double> values);

} // namespace smg
