// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkPoissonTask.h"
#include "smg/ProblemDescription.h"

#include <span>
#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** Throws Error if the requested cell results need more than the cell itself. */
void checkCellResults(const ProblemDescription& problem);

/**
 * Adds the requested cell arrays Gradient and Flux to the output, for a piece of a mesh or its
 * preview with the solution `values` at its points. Throws Error if the piece lacks data of the
 * conductivity.
 */
void addCellResults(vtkPointSet& piece, const ProblemDescription& problem,
  std::span<const double> values, vtkPointSet& output);

/**
 * The reason why a task cannot be solved on the preview of a mesh; empty if it can: the preview is
 * that of a surface, the problem has no boundary conditions, since open edges of a preview are
 * longer, and the preview has all arrays that the problem names and a point in each of its regions.
 */
std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task);

} // namespace smg
