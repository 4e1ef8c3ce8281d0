// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingDistance.h"

#include "Filters/Regions/vtkRegionArrays.h"
#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkDistanceTask.h"
#include "IO/vtkPieceColumns.h"
#include "smg/Deform.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

vtkStandardNewMacro(vtkStreamingDistance);

vtkStreamingDistance::vtkStreamingDistance() = default;

vtkStreamingDistance::~vtkStreamingDistance()
{
  this->SetFrom(nullptr);
}

std::unique_ptr<smg::DistanceTask> vtkStreamingDistance::DescribedTask(vtkPointSet& input) const
{
  auto task = std::make_unique<smg::DistanceTask>();
  smg::SolveOptions common;
  this->FillOptions(common);
  if (!common.checkpoint.folder.empty())
  {
    throw smg::Error("distances have no checkpoints: leave CheckpointDirectory empty");
  }
  task->options.memoryLimit = common.memoryLimit;
  task->options.threads = common.threads;
  task->options.scratch = common.scratch;
  task->options.scratchLimit = common.scratchLimit;
  task->options.maxPasses = this->MaximumPasses;
  task->description.wall = this->Wall;
  task->description.source = this->Source;
  task->description.direction = this->Direction;
  std::vector<smg::Where>& from = task->description.from;
  from = smg::regionsOf(input);
  if (this->From && *this->From)
  {
    std::ranges::move(smg::readPlacesText(this->From, "From"), std::back_inserter(from));
  }
  if (from.empty() && !this->Wall && input.GetPointData()->HasArray(smg::HandleMaskName))
  {
    from.emplace_back(smg::ColumnMask{ smg::HandleMaskName });
  }
  return task;
}

std::unique_ptr<smg::StreamedTask> vtkStreamingDistance::MakeTask(vtkPointSet& input)
{
  return this->DescribedTask(input);
}

smg::SolveSummary vtkStreamingDistance::SolveInMemory(
  vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  if (input.GetNumberOfCells() == 0)
  {
    return this->SummaryOfNothing(0); // of a preview that is in another process
  }
  return this->DescribedTask(input)->solveOnPreview(input, progress, values);
}

void vtkStreamingDistance::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  // Sources and directions of other distances would be taken for those of these.
  output.GetPointData()->RemoveArray(smg::DistanceSourceName);
  output.GetPointData()->RemoveArray(smg::DistanceDirectionName);
  const auto stride = static_cast<std::size_t>(this->GetSummary().columns);
  std::size_t first = 0;
  const auto points = stride == 0 ? 0 : static_cast<std::size_t>(piece.GetNumberOfPoints());
  for (const smg::ColumnSpec& spec : smg::distanceColumns(this->DescribedTask(piece)->description))
  {
    smg::Column column{ spec, {} };
    column.resize(points);
    const auto components = static_cast<std::size_t>(spec.components);
    // As points that are not reached.
    const double ofNoCell = spec.name == smg::DistanceName         ? HUGE_VAL
                            : spec.name == smg::DistanceSourceName ? -1.0
                                                                   : 0.0;
    smg::dispatch(spec.type,
      [&]<class T>(T)
      {
        const std::span<T> to = column.as<T>();
        for (std::size_t i = 0; i < to.size(); ++i)
        {
          const double value = values[i / components * stride + first + i % components];
          to[i] = static_cast<T>(std::isnan(value) ? ofNoCell : value);
        }
      });
    output.GetPointData()->AddArray(smg::makeArray(column));
    first += components;
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
}
