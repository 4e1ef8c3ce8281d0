// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/SolveSummary.h"
#include "IO/Conversion/JobEstimate.h"
#include "smg/Solve.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

class vtkAlgorithm;
class vtkPointSet;
class vtkTable;

namespace smg
{

/** Estimates a computation on a mesh; `present` is what the input delivered last. Throws Error,
 * with a reason. */
using EstimateOf = std::function<JobEstimate(const EstimatedInput& mesh, vtkPointSet& present)>;

/** Processor time for a mesh whose pieces are requested and written to a scratch file. */
double readingSeconds(const StreamInfo& mesh);

/**
 * What a computation of a filter on the whole mesh is expected to cost, in one line, or why that is
 * not known. Requests nothing from the input, as below. `places` has the folder for scratch files
 * and the memory limit.
 */
std::string estimateText(vtkAlgorithm& filter, const ConversionOptions& places,
  const EstimateOf& estimateOf, std::int64_t scratchLimit = 0);

/**
 * What the solve of a filter on the whole mesh is expected to cost, in one line, or why that is not
 * known. Requests nothing from the input: the counts are those of the .vsm file that it names,
 * after UpdateInformation(). `options` have the limits and the scratch folder.
 */
std::string solveEstimate(vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options);

/** The processor time of that, in seconds; none if it is not known. */
std::optional<double> solveSeconds(
  vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options);

/** Fills a table with a row for each pass of a solve, for charts: Pass, Residual, Seconds, and what
 * else it cost that is not the same in all passes. */
void fillPasses(const SolveSummary& summary, vtkTable& table);

/** Fills a table with the sentence that a view is to show, "" if there is nothing to say. */
void fillText(const SolveSummary& summary, vtkTable& table);

} // namespace smg
