// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/vtkPieceResults.h"

#include "Filters/Pieces/vtkPieceBlock.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Mesh/AddedColumn.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

namespace smg
{
namespace
{

/** The data of a problem that the results of the cells depend on. */
ProblemDescription ofCells(const ProblemDescription& problem)
{
  ProblemDescription part;
  part.weights = problem.weights;
  part.columns = problem.columns;
  if (problem.fluxOutput)
  {
    part.conductivity = problem.conductivity;
  }
  return part;
}

void addArray(vtkPointSet& piece, const char* name, int columns, std::span<const double> numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3 * columns);
  array->SetNumberOfTuples(piece.GetNumberOfCells());
  std::ranges::copy(numbers, array->GetPointer(0));
  piece.GetCellData()->AddArray(array);
}

} // namespace

void checkCellResults(const ProblemDescription& problem)
{
  for (const PlacedValue& entry : problem.conductivity.entries)
  {
    if (problem.fluxOutput && (std::holds_alternative<NearestVertices>(entry.where) ||
                                std::holds_alternative<OnBoundary>(entry.where)))
    {
      throw Error(
        "The cell array Flux needs a conductivity that a cell knows by itself: choose its "
        "cells by a region, a tag or a mask instead of the nearest points or the boundary.");
    }
  }
}

void addCellResults(vtkPointSet& piece, const ProblemDescription& problem,
  std::span<const double> values, vtkPointSet& output)
{
  if (piece.GetNumberOfCells() == 0 || !(problem.gradientOutput || problem.fluxOutput))
  {
    return;
  }
  const ProblemDescription part = ofCells(problem);
  const PieceBlock mesh(piece, namedColumns(part));
  DescribedProblem described(part, mesh.info());
  InMemorySolution solution(values, problem.columns);
  ProblemResults results(mesh.info(), described, solution,
    { .gradient = problem.gradientOutput, .flux = problem.fluxOutput });
  results.add(mesh.block());
  if (problem.gradientOutput)
  {
    addArray(output, GradientName, problem.columns, results.gradient());
  }
  if (problem.fluxOutput)
  {
    addArray(output, FluxName, problem.columns, results.flux());
  }
}

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

} // namespace smg
