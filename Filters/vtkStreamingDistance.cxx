// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingDistance.h"

#include "Filters/Distance/vtkDistanceTask.h"
#include "Filters/Streaming/SolveSummary.h"
#include "IO/vtkMeshPieceData.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

vtkStandardNewMacro(vtkStreamingDistance);

vtkStreamingDistance::vtkStreamingDistance() = default;

vtkStreamingDistance::~vtkStreamingDistance()
{
  this->SetFrom(nullptr);
}

std::unique_ptr<smg::DistanceTask> vtkStreamingDistance::DescribedTask() const
{
  auto task = std::make_unique<smg::DistanceTask>();
  smg::SolveOptions common;
  this->FillOptions(common);
  task->options.memoryLimit = common.memoryLimit;
  task->options.threads = common.threads;
  task->options.scratch = common.scratch;
  task->options.maxPasses = this->MaximumPasses;
  task->description.wall = this->Wall;
  task->description.source = this->Source;
  task->description.direction = this->Direction;
  if (this->From && *this->From)
  {
    task->description.from = smg::readPlacesText(this->From, "From");
  }
  return task;
}

std::unique_ptr<smg::StreamedTask> vtkStreamingDistance::MakeTask(vtkPointSet& /*input*/)
{
  return this->DescribedTask();
}

bool vtkStreamingDistance::IsForMemory(vtkPointSet& input, bool isWhole)
{
  return smg::isPreview(input) || (isWhole && input.GetNumberOfPoints() <= this->InteractivePoints);
}

smg::SolveSummary vtkStreamingDistance::SolveInMemory(
  vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  if (input.GetNumberOfCells() == 0)
  {
    if (smg::isPreview(input))
    {
      return this->SummaryOfNothing(0);
    }
    throw smg::Error("The input has no cells: give it a mesh of triangles or tetrahedra.");
  }
  return this->DescribedTask()->solveInMemory(input, progress, values);
}

void vtkStreamingDistance::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  std::size_t first = 0;
  for (const smg::ColumnSpec& spec : smg::distanceColumns(this->DescribedTask()->description))
  {
    const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(
      spec.type == smg::ScalarType::Int64 ? VTK_TYPE_INT64 : VTK_DOUBLE));
    array->SetName(spec.name.c_str());
    array->SetNumberOfComponents(spec.components);
    array->SetNumberOfTuples(stride == 0 ? 0 : piece.GetNumberOfPoints());
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < spec.components; ++k)
      {
        array->SetComponent(
          i, k, values[static_cast<std::size_t>(i) * stride + first + static_cast<std::size_t>(k)]);
      }
    }
    output.GetPointData()->AddArray(array);
    first += static_cast<std::size_t>(spec.components);
  }
  output.GetPointData()->SetActiveScalars(smg::DistanceName);
}

void vtkStreamingDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "From: " << (this->From ? this->From : "(none)") << "\n";
  os << indent << "Wall: " << this->Wall << "\n";
  os << indent << "Source: " << this->Source << "\n";
  os << indent << "Direction: " << this->Direction << "\n";
  os << indent << "MaximumPasses: " << this->MaximumPasses << "\n";
  os << indent << "InteractivePoints: " << this->InteractivePoints << "\n";
}
