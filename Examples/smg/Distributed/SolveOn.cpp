// SPDX-License-Identifier: BSD-3-Clause
#include "OnProcesses.h"
#include "PieceFiles.h"

#include "smg/DescribedProblem.h"
#include "smg/SolvedMesh.h"

namespace
{

void addColumns(
  const smg::DistributedSolution& solution, const smg::ResultOptions& results, PieceResult& result)
{
  PieceResult::add(result.vertexColumns, smg::SolutionName, solution.columns, solution.values);
  if (results.gradient)
  {
    PieceResult::add(
      result.cellColumns, smg::GradientName, 3 * solution.columns, solution.gradient);
  }
  if (results.flux)
  {
    PieceResult::add(result.cellColumns, smg::FluxName, 3 * solution.columns, solution.flux);
  }
}

} // namespace

void solveOn(smg::Team& team, const DistributedJob& job, const DistributedSolve& task)
{
  smg::ResultOptions results;
  const auto on = readDescribed<smg::DescribedProblem>(team, job,
    [&]
    {
      const smg::ProblemDescription description = task.read();
      results = { .gradient = description.gradientOutput,
        .flux = description.fluxOutput,
        .integrals = description.integrals,
        .memoryLimit = job.memoryLimit };
      if (description.vertexGradientOutput && isInPieces(job.out))
      {
        throw smg::Error("gradient at vertices is no output in pieces: write another format than " +
                         job.out.extension().string() + ".");
      }
      return description;
    });
  smg::DistributedSolver solver(team.communicator(), on.part);
  solver.prepare(*on.described, job.scratch, job.memoryLimit);
  smg::DistributedSolution solution = solver.solve(*on.described, optionsOf(job, task.tolerance));
  if (!isInPieces(job.out))
  {
    solver.gather(solution, job.use);
    return;
  }
  solver.evaluate(*on.described, solution, results);
  PieceResult result;
  result.replaces = [](const smg::ColumnSpec& column)
  {
    return column.name == smg::SolutionName || column.name == smg::GradientName ||
           column.name == smg::FluxName;
  };
  team.run([&] { addColumns(solution, results, result); });
  writePieceFiles(team, *on.mesh, std::move(result), job.out);
  reportOn(team, job, solution.report);
}
