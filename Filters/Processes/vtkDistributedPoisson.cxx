// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Processes/vtkDistributedPoisson.h"

#include "Filters/Processes/FreeMemory.h"
#include "Filters/Processes/vtkPiecePart.h"
#include "IO/vtkMeshPieceData.h"
#include "Solver/Description/ComposeDescriptions.h"
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

/** Bytes of a vertex in the part, the matrix and its hierarchy: with those of cells, an upper
 * estimate, 1250 for a vertex of a surface, which took 750 (docs/cluster.md). */
constexpr double BytesOfPoint = 250.0;
/** Bytes of a cell there: its edges are entries of the matrix. */
constexpr double BytesOfCell = 500.0;

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

/** The smallest number of free bytes that a process of a machine can have, over all machines. */
double smallestShare(Team& team)
{
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(
    team.communicator(), MPI_COMM_TYPE_SHARED, team.rank(), MPI_INFO_NULL, &machine);
  int processes = 1;
  MPI_Comm_size(machine, &processes);
  MPI_Comm_free(&machine);
  double share = static_cast<double>(freeMemory()) / processes;
  team.least({ &share, 1 });
  return share;
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
  options.memoryLimit = task.options.memoryLimit;
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
        BytesOfPoint * static_cast<double>(piece.GetNumberOfPoints()) +
          BytesOfCell * static_cast<double>(piece.GetNumberOfCells()) };
      team.largest(std::span<double>(most));
      const double share = smallestShare(team);
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
