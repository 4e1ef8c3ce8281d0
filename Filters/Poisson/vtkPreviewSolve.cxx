// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkPreviewSolve.h"

#include "Filters/Mesh/vtkPieceBlock.h"
#include "Solver/Core/Error.h"
#include "Solver/Description/ComposeDescriptions.h"
#include "Solver/Description/DescribedProblem.h"
#include "Solver/Results/ProblemResults.h"

#include "vtkPolyData.h"

#include <string>

namespace smg
{

bool isPosedOn(vtkPointSet& preview, const ProblemDescription& problem)
{
  if (!vtkPolyData::SafeDownCast(&preview))
  {
    return false;
  }
  if (preview.GetNumberOfCells() == 0)
  {
    return true;
  }
  try
  {
    const PieceBlock mesh(preview, namedColumns(problem));
    DescribedProblem(problem, mesh.info()).prepare(*mesh.source());
    return true;
  }
  catch (const Error&)
  {
    return false;
  }
}

SolveSummary solveOnPreview(
  vtkPointSet& preview, const PoissonTask& task, std::vector<double>& values)
{
  task.check();
  values.clear();
  if (preview.GetNumberOfCells() == 0)
  {
    // A piece other than the first.
    SolveSummary nothing;
    nothing.columns = task.problem.columns;
    nothing.converged = true;
    return nothing;
  }
  const PieceBlock mesh(preview, namedColumns(task.problem));
  DescribedProblem problem(task.problem, mesh.info());
  problem.prepare(*mesh.source());
  SolveOptions options = task.options;
  options.inCore = true;
  const std::unique_ptr<Solution> solution = solve(*mesh.source(), problem, options);
  values.resize(static_cast<std::size_t>(mesh.info().vertices * problem.columns()));
  solution->read(0, mesh.info().vertices, values);

  Report report = solution->report();
  ProblemResults results(mesh.info(), problem, *solution);
  results.add(mesh.block());
  results.finish(report);
  report.notes.push_back(
    "this is the solution on the preview, a mesh of " + std::to_string(mesh.info().vertices) +
    " vertices: it approximates that on the full mesh, which is solved on when "
    "it is saved, or with SolveFullMesh");
  return SolveSummary::of(report, problem.columns());
}

} // namespace smg
