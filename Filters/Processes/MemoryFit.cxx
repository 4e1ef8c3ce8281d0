// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/MemoryFit.h"

#include "Filters/Processes/ProcessParts.h"
#include "IO/Vtk/MeshPieceData.h"
#include "Solver/Core/Text.h"
#include "Solver/Distributed/PartMemory.h"
#include "Solver/Distributed/Team.h"

#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{
namespace
{

std::string mebibytesOf(double bytes)
{
  return mebibytes(static_cast<std::int64_t>(bytes));
}

} // namespace

MemoryFit estimateMemoryFit(vtkPointSet& piece, vtkMultiProcessController* controller, int columns)
{
  const MPI_Comm communicator = communicatorOf(controller);
  if (communicator == MPI_COMM_NULL)
  {
    return { false, "the processes do not communicate by MPI" };
  }
  Team team(communicator);
  MemoryFit verdict;
  team.run(
    [&]
    {
      std::array<double, 3> most{ isPreview(piece) ? 1.0 : 0.0,
        partMemory(piece.GetNumberOfPoints(), piece.GetNumberOfCells(), columns),
        static_cast<double>(piece.GetNumberOfPoints()) };
      team.largest(std::span<double>(most));
      const double share = freeMemoryOfProcess(team);
      if (most[0] > 0.0)
      {
        verdict = { false, "the input is a preview of the mesh" };
        return;
      }
      if (most[2] > static_cast<double>(maxPartVertices()))
      {
        verdict = { false, "a process has more than the " + std::to_string(maxPartVertices()) +
                             " points that hypre can have in one" };
        return;
      }
      verdict.fits = most[1] <= share;
      verdict.reason = "the estimate of " + mebibytesOf(most[1]) + " for a process " +
                       (verdict.fits ? "fits in" : "is more than") + " the " + mebibytesOf(share) +
                       " that are free for it";
    });
  return verdict;
}

} // namespace smg
