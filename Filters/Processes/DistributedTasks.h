// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/DeformationTask.h"
#include "Filters/Tasks/PoissonTask.h"
#include "Filters/Tasks/SolveSummary.h"

#include <functional>
#include <vector>

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{

/** Makes the task from a mesh with the arrays of the input; called on every process. */
using MakePoissonTask = std::function<PoissonTask(vtkPointSet&)>;

/**
 * Solves with the distributed engine on the pieces that the processes of `controller` have. Called
 * on all of them.
 * @param piece that of this process, perhaps without cells
 * @param values set to the solution at all points of the piece, duplicate ones included
 * @throws Error on all processes if one fails, or if the build has no distributed engine
 * @throws Cancelled if the progress function of process 0 returns false
 */
SolveSummary solveInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const MakePoissonTask& taskOf, const ProgressFunction& progress, std::vector<double>& values);

/** Makes the task from a mesh with the arrays of the input; called on every process. */
using MakeDeformationTask = std::function<DeformationTask(vtkPointSet&)>;

/**
 * Deforms with the distributed engine the pieces that the processes of `controller` have. Called on
 * all of them.
 * @param piece that of this process, perhaps without cells
 * @param values set to the values of the task at all points of the piece, duplicate ones included:
 * see DeformedVertices
 * @throws Error on all processes if one fails, or if the build has no distributed engine
 * @throws Cancelled if the progress function of process 0 returns false
 */
SolveSummary deformInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const MakeDeformationTask& taskOf, const ProgressFunction& progress, std::vector<double>& values);

} // namespace smg
