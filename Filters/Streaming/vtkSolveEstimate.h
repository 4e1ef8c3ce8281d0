// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Streaming/vtkStreamedTask.h"
#include "smg/Solve.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

class vtkAlgorithm;
class vtkPointSet;

namespace smg
{

/** Makes the task of a filter from what its input delivered last, which may be nothing. */
using TaskOf = std::function<std::unique_ptr<StreamedTask>(vtkPointSet& input)>;

/**
 * What the solve of a filter on the whole mesh is expected to cost, in one line, or why that is not
 * known. Requests nothing from the input: the counts are those of the .vsm file that it names,
 * after UpdateInformation(). `options` have the limits and the scratch folder.
 */
std::string solveEstimate(vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options);

/** The processor time of that, in seconds; none if it is not known. */
std::optional<double> solveSeconds(
  vtkAlgorithm& filter, const TaskOf& taskOf, const SolveOptions& options);

} // namespace smg
