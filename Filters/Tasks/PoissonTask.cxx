// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Tasks/PoissonTask.h"

#include "Filters/Pieces/PieceBlock.h"
#include "Filters/Pieces/ReplacedArray.h"
#include "Solver/Jobs/Results/ProblemResults.h"
#include "Solver/Mesh/VisitBlocks.h"
#include "Solver/Multigrid/Engine/CheckOptions.h"
#include "Solver/Problem/ComposeDescriptions.h"
#include "smg/DescribedProblem.h"
#include "smg/Error.h"
#include "smg/SolvedMesh.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

PoissonTask::PoissonTask()
  : JobTask("solve")
  , asked(static_cast<SolveJob&>(this->job()))
{
}

void PoissonTask::check() const
{
  const ProblemDescription& problem = this->asked.description;
  if (!isPosed(problem))
  {
    throw Error(
      "Nothing says what to solve: choose a Dirichlet mask with values or a source, put a "
      "Mesh Condition before this filter, or name a problem file.");
  }
  checkCellResults(problem);
  checkOptions(this->asked.solving);
  checkAutomaticTolerance(this->asked.solving, problem.weights);
  checkOperators(this->asked.solving);
}

std::set<std::string> PoissonTask::required() const
{
  return namedColumns(this->asked.description);
}

int PoissonTask::columnsOn(const StreamInfo& info) const
{
  int columns = this->asked.description.columns;
  for (const DataValue& value : this->values)
  {
    // The last one that has the column counts.
    const bool ofCells = value.owner() == DataValue::Owner::Cells;
    int components = 0;
    for (const auto* specs : { ofCells ? &info.vertexColumns : &info.cellColumns,
           ofCells ? &info.cellColumns : &info.vertexColumns })
    {
      const auto found = std::ranges::find(*specs, *value.column(), &ColumnSpec::name);
      components = found == specs->end() ? components : found->components;
    }
    columns = std::max(columns, components);
  }
  return columns;
}

ProblemDescription PoissonTask::description(const StreamInfo& info) const
{
  ProblemDescription description = this->asked.description;
  description.columns = this->columnsOn(info);
  return description;
}

Costs PoissonTask::costs(const StreamInfo& info) const
{
  SolveJob sized;
  sized.description = this->description(info);
  sized.solving = this->asked.solving;
  return sized.costsOn(info);
}

AddedValues PoissonTask::added(const StreamInfo& info) const
{
  SolveJob sized;
  sized.description = this->description(info);
  return sized.addedTo(info);
}

void PoissonTask::prepareFor(const StreamInfo& info)
{
  this->asked.description = this->description(info);
  this->asked.text = textOf(this->asked.description);
}

namespace
{

/** A solution with its gradients at the vertices: n and 3 n columns. */
class SolutionWithGradient final : public Solution
{
public:
  SolutionWithGradient(std::unique_ptr<Solution> values, std::unique_ptr<Solution> gradients)
    : Values(std::move(values))
    , Gradients(std::move(gradients))
  {
  }

  std::int64_t vertices() const override { return this->Values->vertices(); }
  int columns() const override { return this->Values->columns() + this->Gradients->columns(); }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override
  {
    const auto rows = static_cast<std::size_t>(count);
    const auto columns = static_cast<std::size_t>(this->Values->columns());
    std::vector<double> own(rows * columns), gradients(3 * own.size());
    this->Values->read(first, count, own);
    this->Gradients->read(first, count, gradients);
    for (std::size_t row = 0; row < rows; ++row)
    {
      double* to = values.data() + 4 * row * columns;
      to = std::copy_n(own.data() + row * columns, columns, to);
      std::copy_n(gradients.data() + 3 * row * columns, 3 * columns, to);
    }
  }
  void removeCheckpoint() override { this->Values->removeCheckpoint(); }
  const Report& report() const override { return this->Values->report(); }

private:
  std::unique_ptr<Solution> Values, Gradients;
};

} // namespace

void PoissonTask::complete(Result& result, const StoredMesh& mesh, const ProgressFunction& progress)
{
  ProblemDescription& description = this->asked.description;
  // Pieces get their cell arrays when they are delivered.
  description.gradientOutput = description.fluxOutput = false;
  std::unique_ptr<Solution> gradients;
  this->asked.passResult(
    mesh, *result.solution,
    [&](MeshSource& solved, const ProgressFunction& read)
    {
      visitBlocks(solved, read, 0.0, 1.0, [](const MeshBlock&) {});
      gradients = dynamic_cast<SolvedMesh&>(solved).takeVertexGradients();
    },
    result.report, progress);
  if (gradients)
  {
    result.solution =
      std::make_unique<SolutionWithGradient>(std::move(result.solution), std::move(gradients));
  }
}

int columnsWithoutGradient(const ProblemDescription& problem, int columns)
{
  return problem.vertexGradientOutput ? columns / 4 : columns;
}

namespace
{

/** Whether ParaView, between a filter and this one, has made the point array of that of the cells.
 */
bool isMadeByParaView(vtkAlgorithm& filter, const std::string& name)
{
  vtkAlgorithm* before =
    filter.GetNumberOfInputConnections(0) > 0 ? filter.GetInputAlgorithm(0, 0) : nullptr;
  if (!before || !before->IsA("vtkPVPostFilter") || before->GetNumberOfInputConnections(0) == 0)
  {
    return false;
  }
  auto* mesh = vtkPointSet::SafeDownCast(before->GetInputDataObject(0, 0));
  return mesh && mesh->GetCellData()->HasArray(name.c_str()) &&
         !mesh->GetPointData()->HasArray(name.c_str());
}

} // namespace

std::string ChosenArrays::named(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const char* chosen =
    info.Has(vtkDataObject::FIELD_NAME()) ? info.Get(vtkDataObject::FIELD_NAME()) : nullptr;
  const std::string name = chosen ? chosen : "";
  return name == "None" ? "" : name;
}

/** In pvpython a name alone means the points, for which ParaView makes an array out of that of the
 * cells: this is not what was chosen. */
DataValue ChosenArrays::any(int index) const
{
  using Owner = DataValue::Owner;
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const std::string name = this->named(index);
  const int of = info.Has(vtkDataObject::FIELD_ASSOCIATION())
                   ? info.Get(vtkDataObject::FIELD_ASSOCIATION())
                   : vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  const bool isOfPoints =
    of == vtkDataObject::FIELD_ASSOCIATION_POINTS && !isMadeByParaView(this->Filter, name);
  const bool isOfCells =
    of == vtkDataObject::FIELD_ASSOCIATION_CELLS || of == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  return { name, isOfPoints ? Owner::Vertices : isOfCells ? Owner::Cells : Owner::Usual };
}

std::string ChosenArrays::ofPoints(int index) const
{
  vtkInformation& info = *this->Filter.GetInputArrayInformation(index);
  const std::string name = this->named(index);
  if (!name.empty() && info.Has(vtkDataObject::FIELD_ASSOCIATION()) &&
      info.Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    throw Error("The array " + name +
                " is chosen from the cells: a point array is needed; use a filter that turns cell "
                "data into point data.");
  }
  return name;
}

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
  addResult(*piece.GetCellData(), *array);
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
  const ProblemDescription& problem = task.asked.description;
  if (!problem.flux.empty() || !problem.robin.empty())
  {
    return "the preview has open edges that the mesh has not, where flux and exchange would act";
  }
  try
  {
    if (preview.GetNumberOfCells() > 0)
    {
      const PieceBlock mesh(preview, namedColumns(problem));
      const SolveOptions& options = task.asked.solving;
      DescribedProblem(problem, mesh.info())
        .prepare(*mesh.source(), options.scratch, options.memoryLimit);
    }
    return {};
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

} // namespace smg
