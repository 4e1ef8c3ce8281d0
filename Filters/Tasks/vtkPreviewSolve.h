// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkPoissonTask.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/**
 * The reason why a task cannot be solved on the preview of a mesh; empty if it can: the preview is
 * that of a surface, the problem has no boundary conditions, since open edges of a preview are
 * longer, and the preview has all arrays that the problem names and a point in each of its regions.
 */
std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task);

/** Solves a problem in memory on the preview of a mesh and returns the values at the points of the
 * preview, with a note in the report. Throws Error and Cancelled. */
SolveSummary solveOnPreview(
  vtkPointSet& preview, const PoissonTask& task, std::vector<double>& values);

} // namespace smg
