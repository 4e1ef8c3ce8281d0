// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/JobTask.h"
#include "Filters/Tasks/SolveSummary.h"

#include <vector>

class vtkMultiProcessController;
class vtkPointSet;

namespace smg
{

/**
 * Solves the problem of a PoissonTask with the distributed engine on the pieces that the processes
 * of `controller` have. Called on all of them.
 * @param piece that of this process, perhaps without cells
 * @param values set to the solution at all points of the piece, duplicate ones included
 * @throws Error on all processes if one fails, or if the build has no distributed engine
 * @throws Cancelled if the progress function of process 0 returns false
 */
SolveSummary solveInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const TaskOf& taskOf, const ProgressFunction& progress, std::vector<double>& values);

/**
 * Deforms, by a DeformationTask, with the distributed engine the pieces that the processes of
 * `controller` have. Called on all of them.
 * @param piece that of this process, perhaps without cells
 * @param values set to the values of the task at all points of the piece, duplicate ones included:
 * see DeformedVertices
 * @throws Error on all processes if one fails, or if the build has no distributed engine
 * @throws Cancelled if the progress function of process 0 returns false
 */
SolveSummary deformInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const TaskOf& taskOf, const ProgressFunction& progress, std::vector<double>& values);

} // namespace smg
