// SPDX-License-Identifier: BSD-3-Clause
#include "../DistributedEngine.h"

#include "PieceFiles.h"
#include "ReadPart.h"

#include "Solver/Distributed/Team.h"
#include "smg/DescribedProblem.h"
#include "smg/DistributedSolver.h"
#include "smg/VsmReader.h"

#include <mpi.h>

#include <memory>
#include <numeric>
#include <vector>

namespace
{

/** MPI, from construction to destruction. */
class Mpi
{
public:
  Mpi()
  {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;
};

void solveOn(smg::Team& team, const DistributedSolve& task)
{
  const bool isFirst = team.rank() == 0;
  std::unique_ptr<smg::VsmReader> mesh;
  std::unique_ptr<smg::DescribedProblem> problem;
  smg::ResultOptions results;
  smg::MeshPart part;
  team.run(
    [&]
    {
      if (isFirst)
      {
        task.check();
      }
      team.agree();
      mesh = std::make_unique<smg::VsmReader>(task.in);
      part.info = infoOfPart(mesh->info());
      const smg::ProblemDescription description = task.read();
      results = { description.gradientOutput, description.fluxOutput, task.memoryLimit };
      problem = std::make_unique<smg::DescribedProblem>(description, part.info, task.problem);
      readPart(*mesh, *problem, team.rank(), team.size(), part);
      // Vertices belong to the process whose cells come first, in their order.
      const std::vector<std::int64_t> owned =
        team.gather(std::vector<std::int64_t>{ part.endOwned - part.firstOwned });
      part.firstOwned =
        std::accumulate(owned.begin(), owned.begin() + team.rank(), std::int64_t(0));
      part.endOwned = part.firstOwned + owned[static_cast<std::size_t>(team.rank())];
    });
  smg::DistributedSolver solver(team.communicator(), part);
  solver.prepare(*problem, task.scratch);
  smg::DistributedOptions options;
  options.tolerance = task.tolerance;
  options.maxIterations = task.maxIterations;
  options.memoryLimit = task.memoryLimit;
  options.progress = task.progress;
  smg::DistributedSolution solution = solver.solve(*problem, options);
  if (!isInPieces(task.out))
  {
    solver.gather(solution, task.use);
    return;
  }
  solver.evaluate(*problem, solution, results);
  writePieceFiles(team, *mesh, solution, results, task.out);
  team.run(
    [&]
    {
      if (isFirst)
      {
        task.report(solution.report);
      }
    });
}

int solve(const DistributedSolve& task)
{
  const Mpi mpi;
  smg::Team team(MPI_COMM_WORLD);
  try
  {
    solveOn(team, task);
    return 0;
  }
  catch (const smg::Error&)
  {
    // The first process says it for all.
    if (team.rank() == 0)
    {
      throw;
    }
    return 1;
  }
}

} // namespace

extern "C" const DistributedEngine* smgDistributedEngine()
{
  static constexpr DistributedEngine engine{ solve };
  return &engine;
}
