// SPDX-License-Identifier: BSD-3-Clause
// In place of vtkDistributedPoisson.cxx where MPI or hypre is missing.
#include "Filters/Processes/vtkDistributedPoisson.h"

#include "smg/Error.h"

namespace smg
{

SolveSummary solveInProcesses(vtkPointSet&, vtkMultiProcessController*, const MakePoissonTask&,
  const ProgressFunction&, std::vector<double>&)
{
  throw Error("This build has no distributed engine, which needs MPI and hypre (SMG_USE_HYPRE): "
              "choose the Engine Streaming.");
}

MemoryVerdict judgeMemory(vtkPointSet&, vtkMultiProcessController*)
{
  return { false, "this build has no distributed engine" };
}

} // namespace smg
