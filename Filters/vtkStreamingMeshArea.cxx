// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshArea.h"

#include "Filters/Pieces/ReplacedArray.h"
#include "Filters/Tasks/SolveSummary.h"
#include "smg/Area.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkTable.h"

#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkStreamingMeshArea);

vtkStreamingMeshArea::vtkStreamingMeshArea()
  : vtkStreamingSolver("area")
{
  this->SetNumberOfOutputPorts(AREAS + 1);
}

vtkStreamingMeshArea::~vtkStreamingMeshArea() = default;

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
