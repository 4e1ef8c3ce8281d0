// SPDX-License-Identifier: BSD-3-Clause
// In place of the functions for several processes where MPI or hypre is missing.
#include "Filters/Processes/DistributedTasks.h"
#include "Filters/Processes/MemoryFit.h"

#include "smg/Error.h"

namespace smg
{
namespace
{

[[noreturn]] void fail()
{
  throw Error("This build has no distributed engine, which needs MPI and hypre (SMG_USE_HYPRE): "
              "choose the Engine Streaming.");
}

} // namespace

SolveSummary solveInProcesses(vtkPointSet&, vtkMultiProcessController*, const TaskOf&,
  const ProgressFunction&, std::vector<double>&)
{
  fail();
}

SolveSummary deformInProcesses(vtkPointSet&, vtkMultiProcessController*, const TaskOf&,
  const ProgressFunction&, std::vector<double>&)
{
  fail();
}

MemoryFit estimateMemoryFit(vtkPointSet&, vtkMultiProcessController*, int)
{
  return { false, "this build has no distributed engine" };
}

} // namespace smg
