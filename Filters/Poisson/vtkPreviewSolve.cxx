// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Poisson/vtkPreviewSolve.h"

#include "Filters/Mesh/vtkPieceBlock.h"
#include "Solver/Core/Error.h"
#include "Solver/Description/ComposeDescriptions.h"
#include "Solver/Description/DescribedProblem.h"
#include "Solver/Results/ProblemResults.h"
#include "Solver/Stream/OriginalNumbers.h"

#include "vtkPolyData.h"

#include <string>

namespace smg
{

std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task)
{
  if (!vtkPolyData::SafeDownCast(&preview))
  {
    return "the preview of a solid is its surface";
  }
  try
  {
    if (preview.GetNumberOfCells() > 0)
    {
      const PieceBlock mesh(preview, namedColumns(task.problem));
      DescribedProblem(task.problem, mesh.info()).prepare(*mesh.source(), task.options.scratch);
    }
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

namespace
{

/** Gives the vertices of extremes their numbers in the user's file, or in the stream. */
void nameByFile(const MeshBlock& block, Report& report)
{
  const std::ptrdiff_t column = findColumn(block.vertexColumns, OriginalIdSpec);
  for (std::vector<Report::Extreme>* extremes : { &report.minimum, &report.maximum })
  {
    for (Report::Extreme& extreme : *extremes)
    {
      if (extreme.vertex >= 0 && column >= 0)
      {
        const Column& ids = block.vertexColumns[static_cast<std::size_t>(column)];
        extreme.vertex = ids.as<std::int64_t>()[static_cast<std::size_t>(extreme.vertex)];
      }
    }
  }
}

} // namespace

SolveSummary solveOnPreview(
  vtkPointSet& preview, const PoissonTask& task, std::vector<double>& values)
{
  task.check();
  values.clear();
  const PieceBlock mesh(preview, namedColumns(task.problem));
  DescribedProblem problem(task.problem, mesh.info());
  problem.prepare(*mesh.source(), task.options.scratch);
  SolveOptions options = task.options;
  options.inCore = true;
  const std::unique_ptr<Solution> solution = solve(*mesh.source(), problem, options);
  values.resize(static_cast<std::size_t>(mesh.info().vertices * problem.columns()));
  solution->read(0, mesh.info().vertices, values);

  Report report = solution->report();
  ProblemResults results(mesh.info(), problem, *solution);
  results.add(mesh.block());
  results.finish(report);
  nameByFile(mesh.block(), report);
  report.notes.push_back(
    "this is the solution on the preview, a mesh of " + std::to_string(mesh.info().vertices) +
    " vertices: it approximates that on the full mesh, which is solved on when "
    "it is saved, or with SolveFullMesh");
  return SolveSummary::of(report, problem.columns());
}

} // namespace smg
