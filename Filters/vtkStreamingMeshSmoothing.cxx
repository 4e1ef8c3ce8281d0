// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshSmoothing.h"

#include "Filters/Pieces/vtkReplacedArray.h"
#include "Filters/Regions/vtkRegionArrays.h"
#include "Filters/Tasks/SolveSummary.h"
#include "Filters/Tasks/vtkMovedPiece.h"
#include "Filters/Tasks/vtkSmoothingTask.h"
#include "smg/DescriptionFiles.h"
#include "smg/Error.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iterator>
#include <string>

vtkStandardNewMacro(vtkStreamingMeshSmoothing);

struct vtkStreamingMeshSmoothing::Internals
{
  explicit Internals(vtkStreamingMeshSmoothing& self)
    : Self(self)
  {
  }

  /** "None" is what ParaView offers for no array. */
  std::string column() const
  {
    const auto named = [](const char* name)
    { return name && std::string(name) != "None" ? std::string(name) : std::string(); };
    const std::string array = named(this->Self.Array);
    return array.empty() ? named(this->Self.Column) : array;
  }

  smg::Smoothing options(vtkPointSet& input) const
  {
    smg::Smoothing options;
    this->Self.FillOptions(options);
    // Both enumerations have the same order.
    options.size = { this->Self.Size, static_cast<smg::SmoothingSize::Unit>(this->Self.SizeUnit) };
    options.steps = this->Self.Steps;
    options.keepVolume = this->Self.KeepVolume;
    options.column = this->column();
    if (this->Self.KeepEdges)
    {
      options.keepEdges = this->Self.EdgeAngle;
    }
    if (this->Self.Boundary != AUTOMATIC)
    {
      options.boundary = static_cast<smg::SmoothedBoundary>(this->Self.Boundary - SMOOTH);
    }
    options.hold = smg::regionsOf(input);
    if (this->Self.Hold && *this->Self.Hold)
    {
      std::ranges::move(
        smg::readPlacesText(this->Self.Hold, "Hold"), std::back_inserter(options.hold));
    }
    return options;
  }

  std::unique_ptr<smg::SmoothingTask> task(vtkPointSet& input) const
  {
    auto task = std::make_unique<smg::SmoothingTask>();
    task->options = this->options(input);
    task->needsNormals = this->column().empty() && this->Self.Normals == RECOMPUTE &&
                         vtkPolyData::SafeDownCast(&input) &&
                         smg::findNormals(*input.GetPointData());
    return task;
  }

  vtkStreamingMeshSmoothing& Self;
};

vtkStreamingMeshSmoothing::vtkStreamingMeshSmoothing()
  : Internal(new Internals(*this))
{
}

vtkStreamingMeshSmoothing::~vtkStreamingMeshSmoothing()
{
  this->SetHold(nullptr);
  this->SetArray(nullptr);
  this->SetColumn(nullptr);
}

std::unique_ptr<smg::StreamedTask> vtkStreamingMeshSmoothing::MakeTask(vtkPointSet& input)
{
  return this->Internal->task(input);
}

smg::SolveSummary vtkStreamingMeshSmoothing::SolveInMemory(
  vtkPointSet& input, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  if (input.GetNumberOfCells() == 0)
  {
    return this->SummaryOfNothing(3); // of a preview that is in another process
  }
  return this->Internal->task(input)->solveOnPreview(input, progress, values);
}

int vtkStreamingMeshSmoothing::ComparedColumns(int columns)
{
  return this->Internal->column().empty() ? 3 : columns;
}

void vtkStreamingMeshSmoothing::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  if (!this->Internal->column().empty())
  {
    output.ShallowCopy(&piece);
    const auto components = static_cast<std::size_t>(this->GetSummary().columns);
    smg::replaceArray(output, this->Internal->column(), values, 0, components);
    return;
  }
  smg::movePiece(piece,
    { .values = values,
      .columns = this->GetSummary().columns,
      .needsCellNormals = this->Normals == RECOMPUTE },
    output);
}

void vtkStreamingMeshSmoothing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  constexpr const char* units[] = { "mean edges", "mesh unit", "diagonal" };
  constexpr const char* boundaries[] = { "automatic", "smooth", "fixed", "free" };
  os << indent << "Size: " << this->Size << "\n";
  os << indent << "SizeUnit: " << units[this->SizeUnit] << "\n";
  os << indent << "Steps: " << this->Steps << "\n";
  os << indent << "KeepVolume: " << this->KeepVolume << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "EdgeAngle: " << this->EdgeAngle << "\n";
  os << indent << "Boundary: " << boundaries[this->Boundary] << "\n";
  os << indent << "Hold: " << (this->Hold ? this->Hold : "(none)") << "\n";
  os << indent << "Array: " << (this->Array ? this->Array : "(none)") << "\n";
  os << indent << "Column: " << (this->Column ? this->Column : "(none)") << "\n";
  os << indent << "Normals: " << (this->Normals == RECOMPUTE ? "recompute" : "drop") << "\n";
}
