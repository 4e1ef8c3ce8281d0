// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkPreviewSolve.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Jobs/Results/RenumberExtremes.h"
#include "Solver/Mesh/OriginalNumbers.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"

#include "vtkPolyData.h"

#include <string>

namespace smg
{

std::string whyNotOn(vtkPointSet& preview, const PoissonTask& task)
{
  if (!vtkPolyData::SafeDownCast(&preview))
  {
    return "the boundary of a solid's preview is not that of the mesh";
  }
  if (!task.problem.flux.empty() || !task.problem.robin.empty())
  {
    return "the preview has open edges that the mesh has not, where flux and exchange would act";
  }
  try
  {
    if (preview.GetNumberOfCells() > 0)
    {
      const PieceBlock mesh(preview, namedColumns(task.problem));
      DescribedProblem(task.problem, mesh.info())
        .prepare(*mesh.source(), task.options.scratch, task.options.memoryLimit);
    }
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

SolveSummary solveOnPreview(
  vtkPointSet& preview, const PoissonTask& task, std::vector<double>& values)
{
  task.check();
  values.clear();
  const PieceBlock mesh(preview, namedColumns(task.problem));
  DescribedProblem problem(task.problem, mesh.info());
  problem.prepare(*mesh.source(), task.options.scratch, task.options.memoryLimit);
  SolveOptions options = task.options;
  options.inCore = true;
  options.checkpoint = {};
  options.again = [&mesh] { return mesh.source(); };
  const std::unique_ptr<Solution> solution = solve(*mesh.source(), problem, options);
  values.resize(static_cast<std::size_t>(mesh.info().vertices * problem.columns()));
  solution->read(0, mesh.info().vertices, values);

  Report report = solution->report();
  ProblemResults results(mesh.info(), problem, *solution);
  results.add(mesh.block());
  results.finish(report);
  const std::vector<Column>& columns = mesh.block().vertexColumns;
  if (const std::ptrdiff_t ids = findColumn(columns, OriginalIdSpec); ids >= 0)
  {
    const auto numbers = columns[static_cast<std::size_t>(ids)].as<std::int64_t>();
    renumberExtremes(
      report, [&](std::int64_t vertex) { return numbers[static_cast<std::size_t>(vertex)]; });
  }
  report.notes.push_back(
    "this is the solution on the preview, a mesh of " + std::to_string(mesh.info().vertices) +
    " vertices: it approximates that on the full mesh, which is solved on when "
    "it is saved, or with Solve: Full Mesh");
  return SolveSummary::of(report, problem.columns());
}

} // namespace smg
