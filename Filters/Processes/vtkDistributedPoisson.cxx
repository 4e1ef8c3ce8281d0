// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/vtkDistributedPoisson.h"

#include "Filters/Processes/vtkPiecePart.h"
#include "IO/vtkMeshPieceData.h"
#include "Solver/Description/ComposeDescriptions.h"
#include "Solver/Distributed/FreeMemory.h"
#include "Solver/Distributed/PartMemory.h"
#include "Solver/Distributed/Team.h"
#include "Solver/Stream/OriginalNumbers.h"
#include "smg/DescribedProblem.h"
#include "smg/DistributedSolver.h"
#include "smg/Error.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>

namespace smg
{
namespace
{

/** A position or displacement: the most right-hand sides that are usual. */
constexpr int UsualColumns = 3;

/** MPI_COMM_NULL: the processes do not communicate by MPI. */
MPI_Comm communicatorOf(vtkMultiProcessController* controller)
{
  auto* communicator =
    controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
  vtkMPICommunicatorOpaqueComm* handle = communicator ? communicator->GetMPIComm() : nullptr;
  return handle ? *handle->GetHandle() : MPI_COMM_NULL;
}

void checkTask(const PoissonTask& task)
{
  task.check();
  if (!task.options.checkpoint.folder.empty())
  {
    throw Error("The distributed engine has no checkpoints: leave CheckpointDirectory empty, or "
                "choose the Engine Streaming.");
  }
}

std::set<std::string> columnsOf(const PoissonTask& task)
{
  std::set<std::string> names = namedColumns(task.problem);
  names.insert({ CellFlagsName, OriginalIdName, OriginalCellIdName });
  return names;
}

std::string gibibytes(double bytes)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << bytes / (1 << 30) << " GiB";
  return text.str();
}

} // namespace

SolveSummary solveInProcesses(vtkPointSet& piece, vtkMultiProcessController* controller,
  const MakePoissonTask& taskOf, const ProgressFunction& progress, std::vector<double>& values)
{
  const MPI_Comm communicator = communicatorOf(controller);
  if (communicator == MPI_COMM_NULL)
  {
    throw Error("The distributed engine needs processes that communicate by MPI: start pvbatch or "
                "pvserver with mpiexec, or choose the Engine Streaming.");
  }
  Team team(communicator);
  PoissonTask task;
  PiecePart piecePart;
  std::optional<DescribedProblem> problem;
  team.run(
    [&]
    {
      if (isPreview(piece))
      {
        throw Error("The input is a preview of the mesh, but the distributed engine needs the "
                    "mesh: raise MaximumPointsInMemory of the reader, or choose the Engine "
                    "Streaming.");
      }
      const vtkSmartPointer<vtkPointSet> sample = sampleOf(piece, team, *controller);
      task = taskOf(*sample);
      checkTask(task);
      piecePart = partOfPiece(piece, *sample, columnsOf(task), team);
      problem.emplace(task.description(piecePart.part.info), piecePart.part.info);
    });
  DistributedSolver solver(team.communicator(), piecePart.part);
  solver.checkCells();
  solver.prepare(*problem, task.options.scratch);
  DistributedOptions options;
  options.tolerance = task.options.tolerance;
  options.maxIterations = task.options.maxCycles;
  options.progress = progress;
  DistributedSolution solution = solver.solve(*problem, options);
  solver.evaluate(*problem, solution, { .memoryLimit = options.memoryLimit });

  const auto columns = static_cast<std::size_t>(solution.columns);
  values.clear();
  for (const std::int64_t vertex : piecePart.places)
  {
    const auto first = solution.values.begin() + vertex * solution.columns;
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(columns));
  }
  solution.report.notes.insert(solution.report.notes.end(), task.notes.begin(), task.notes.end());
  return SolveSummary::of(solution.report, solution.columns);
}

MemoryVerdict judgeMemory(vtkPointSet& piece, vtkMultiProcessController* controller)
{
  const MPI_Comm communicator = communicatorOf(controller);
  if (communicator == MPI_COMM_NULL)
  {
    return { false, "the processes do not communicate by MPI" };
  }
  Team team(communicator);
  MemoryVerdict verdict;
  team.run(
    [&]
    {
      std::array<double, 2> most{ isPreview(piece) ? 1.0 : 0.0,
        partMemory(piece.GetNumberOfPoints(), piece.GetNumberOfCells(), UsualColumns) };
      team.largest(std::span<double>(most));
      const double share = freeMemoryOfProcess(team);
      if (most[0] > 0.0)
      {
        verdict = { false, "the input is a preview of the mesh" };
        return;
      }
      verdict.fits = most[1] <= share;
      verdict.reason = "the estimate of " + gibibytes(most[1]) + " for a process " +
                       (verdict.fits ? "fits in" : "is more than") + " the " + gibibytes(share) +
                       " that are free for it";
    });
  return verdict;
}

} // namespace smg
