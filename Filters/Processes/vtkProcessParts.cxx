// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/vtkProcessParts.h"

#include "IO/vtkMeshPieceData.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "smg/Error.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <cstdint>

namespace smg
{
namespace
{

MPI_Comm requiredCommunicator(vtkMultiProcessController* controller)
{
  const MPI_Comm communicator = communicatorOf(controller);
  if (communicator == MPI_COMM_NULL)
  {
    throw Error("The distributed engine needs processes that communicate by MPI: start pvbatch or "
                "pvserver with mpiexec, or choose the Engine Streaming.");
  }
  return communicator;
}

} // namespace

MPI_Comm communicatorOf(vtkMultiProcessController* controller)
{
  auto* communicator =
    controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
  vtkMPICommunicatorOpaqueComm* handle = communicator ? communicator->GetMPIComm() : nullptr;
  return handle ? *handle->GetHandle() : MPI_COMM_NULL;
}

ProcessParts::ProcessParts(
  vtkPointSet& piece, vtkMultiProcessController* controller, const Begin& begin)
  : Processes(requiredCommunicator(controller))
{
  this->Processes.run(
    [&]
    {
      if (isPreview(piece))
      {
        throw Error("The input is a preview of the mesh, but the distributed engine needs the "
                    "mesh: raise MaximumPointsInMemory of the reader, or choose the Engine "
                    "Streaming.");
      }
      const vtkSmartPointer<vtkPointSet> sample = sampleOf(piece, this->Processes, *controller);
      this->Piece = partOfPiece(piece, *sample, begin(*sample), this->Processes);
    });
  this->Solver.emplace(this->Processes.communicator(), this->Piece.part);
  this->Solver->checkCells();
}

void ProcessParts::requireSame(const std::string& what, const std::string& value)
{
  this->Processes.run([&] { this->Processes.requireSame(what, value); });
}

SolveSummary ProcessParts::summarize(Report& report, const std::vector<std::string>& notes,
  const std::vector<double>& values, int columns, std::vector<double>& atPoints)
{
  SolveSummary summary;
  this->Processes.run(
    [&]
    {
      atPoints.clear();
      atPoints.reserve(this->Piece.places.size() * static_cast<std::size_t>(columns));
      for (const std::int64_t vertex : this->Piece.places)
      {
        const auto first = values.begin() + vertex * columns;
        atPoints.insert(atPoints.end(), first, first + columns);
      }
      report.notes.insert(report.notes.end(), notes.begin(), notes.end());
      summary = SolveSummary::of(report, columns);
    });
  return summary;
}

DistributedOptions distributedOptions(const SolveOptions& options, const ProgressFunction& progress)
{
  // Its memory limit is for the streaming engine.
  return { options.tolerance, options.maxCycles, INT64_MAX, progress };
}

void checkForProcesses(const SolveOptions& options)
{
  refuseAutomaticTolerance(options, "the distributed engine");
  if (!options.checkpoint.folder.empty())
  {
    throw Error("The distributed engine has no checkpoints: leave CheckpointDirectory empty, or "
                "choose the Engine Streaming.");
  }
}

} // namespace smg
