// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Poisson/vtkPoissonTask.h"
#include "Filters/Streaming/SolveSummary.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/**
 * Why a task cannot be solved on the preview of a mesh in its place; empty if it can: the preview
 * is that of a surface, the problem has no conditions of the boundary, which clustering does not
 * keep, it has all arrays that the problem names, and a point in each of its regions.
 */
std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task);

/**
 * Solves a problem in memory on the preview of a mesh, in its place, and gives the values at the
 * points of the preview; the report says that it is one. Throws Error and Cancelled.
 */
SolveSummary solveOnPreview(
  vtkPointSet& preview, const PoissonTask& task, std::vector<double>& values);

} // namespace smg
