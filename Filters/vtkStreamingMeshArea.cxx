// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshArea.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Regions/RegionArrays.h"
#include "Filters/Tasks/JobTask.h"
#include "IO/Jobs/AreaJob.h"
#include "IO/Jobs/JobProperties.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkTable.h"

#include <cmath>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkStreamingMeshArea);

namespace
{

class AreaTask : public smg::JobTask
{
public:
  smg::AreaJob asked;

  AreaTask()
    : JobTask("these are areas of the mesh in memory", "measured")
  {
  }

protected:
  smg::AreaJob& job() override { return this->asked; }
  std::vector<smg::Where>& places() override { return this->asked.description.of; }

  void complete(
    Result& result, const smg::StoredMesh& /*mesh*/, const smg::ProgressFunction&) override
  {
    const smg::Report::Areas& areas = *result.report.areas;
    result.report.notes.push_back((areas.isVolume ? "volume " : "area ") +
                                  smg::shortest(areas.total) + " of " +
                                  smg::counted(areas.cells, "cell", "cells"));
  }
};

} // namespace

vtkStreamingMeshArea::vtkStreamingMeshArea()
  : vtkStreamingSolver("area")
{
  this->SetNumberOfOutputPorts(AREAS + 1);
}

vtkStreamingMeshArea::~vtkStreamingMeshArea() = default;

std::unique_ptr<smg::JobTask> vtkStreamingMeshArea::MakeTask(vtkPointSet& input)
{
  auto task = std::make_unique<AreaTask>();
  smg::SolveOptions& options = task->asked.running;
  this->FillOptions(options);
  task->setLimits(options);
  if (!options.checkpoint.folder.empty())
  {
    throw smg::Error("areas have no checkpoints: leave CheckpointDirectory empty");
  }
  this->Options->applyTo(task->asked);
  task->asked.description.of = smg::placesOn(input, this->GetOf(), "Of");
  return task;
}

void vtkStreamingMeshArea::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  const vtkNew<vtkDoubleArray> shares;
  const smg::Report& report = this->GetSummary().facts;
  shares->SetName(report.areas && report.areas->isVolume ? smg::VolumeName : smg::AreaName);
  shares->SetNumberOfTuples(this->GetSummary().columns == 0 ? 0 : piece.GetNumberOfPoints());
  for (vtkIdType i = 0; i < shares->GetNumberOfTuples(); ++i)
  {
    // Points of no cell have none.
    const double share = values[static_cast<std::size_t>(i)];
    shares->SetValue(i, std::isnan(share) ? 0.0 : share);
  }
  smg::addResult(*output.GetPointData(), *shares);
  output.GetPointData()->SetActiveScalars(shares->GetName());
}

void vtkStreamingMeshArea::FillFurtherOutputs(
  const smg::SolveSummary& summary, vtkInformationVector& outputVector)
{
  this->Superclass::FillFurtherOutputs(summary, outputVector);
  const vtkNew<vtkDoubleArray> tags, areas;
  const vtkNew<vtkIdTypeArray> cells;
  const auto found = summary.facts.areas.value_or(smg::Report::Areas());
  for (const smg::Report::Area& part : found.by_tag)
  {
    tags->InsertNextValue(part.tag);
    cells->InsertNextValue(static_cast<vtkIdType>(part.cells));
    areas->InsertNextValue(part.area);
  }
  tags->SetName("Tag");
  cells->SetName("Cells");
  areas->SetName(found.isVolume ? smg::VolumeName : smg::AreaName);
  vtkTable& table = *vtkTable::GetData(&outputVector, AREAS);
  table.Initialize();
  table.AddColumn(tags);
  table.AddColumn(cells);
  table.AddColumn(areas);
}
