// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkStreamingMeshDeformation.h"

#include "Filters/Pieces/CoarserPreview.h"
#include "Filters/Processes/DistributedTasks.h"
#include "Filters/Regions/HandleArrays.h"
#include "Filters/Tasks/DeformationTask.h"
#include "Filters/Tasks/InteractiveMesh.h"
#include "Filters/Tasks/MovedPiece.h"
#include "Filters/Tasks/SolveSummary.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/OrdinaryMesh.h"
#include "IO/Vtk/PropertyRange.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

vtkStandardNewMacro(vtkStreamingMeshDeformation);

struct vtkStreamingMeshDeformation::Internals
{
  explicit Internals(vtkStreamingMeshDeformation& self)
    : Self(self)
  {
  }

  smg::DeformOptions options() const
  {
    smg::DeformOptions options;
    this->Self.FillOptions(options);
    options.weights = this->Self.ChosenWeights();
    options.cycles = this->Self.GetCycles();
    return options;
  }

  /** Whether a whole mesh is deformed in memory: if that needs no more than the limit. */
  bool isInteractive(vtkPointSet& mesh) const
  {
    const std::int64_t points = mesh.GetNumberOfPoints();
    return points <= this->Self.InteractivePoints && this->Self.Engine != DISTRIBUTED &&
           points * smg::DeformationTask::BytesInMemory <= this->options().memoryLimit;
  }

  vtkStreamingMeshDeformation& Self;
  smg::InteractiveMesh Interactive, OfCoarser; ///< on the mesh, and on a coarser preview of it
  smg::KeptCoarserPreview Dragged;
};

vtkStreamingMeshDeformation::vtkStreamingMeshDeformation()
  : vtkMultiEngineSolver("deform")
  , Internal(new Internals(*this))
{
  this->SetWeights(CLAMPED);
  this->SetSolve(ON_PREVIEW);
}

vtkStreamingMeshDeformation::~vtkStreamingMeshDeformation() = default;

int vtkStreamingMeshDeformation::GetNumberOfBuilds()
{
  return this->Internal->Interactive.builds();
}

void vtkStreamingMeshDeformation::CheckRanges() const
{
  this->Superclass::CheckRanges();
  smg::requireInRange(
    { { "InteractivePoints", this->InteractivePoints, 0 }, { "DragPoints", this->DragPoints, 8 } });
}

std::unique_ptr<smg::JobTask> vtkStreamingMeshDeformation::MakeTask(vtkPointSet& input)
{
  if (input.GetNumberOfPoints() > 0)
  {
    smg::HandleArrays::require(input);
  }
  auto task = std::make_unique<smg::DeformationTask>();
  task->asked.deforming = this->Internal->options();
  task->needsNormals = this->GetNormals() == RECOMPUTE && smg::findNormals(*input.GetPointData());
  task->interactive = &this->Internal->Interactive;
  if (!this->GetEngineNote().empty())
  {
    task->notes.push_back(this->GetEngineNote());
  }
  return task;
}

std::unique_ptr<smg::JobTask> vtkStreamingMeshDeformation::MakeEstimatedTask(vtkPointSet& input)
{
  std::unique_ptr<smg::JobTask> task = this->MakeTask(input);
  const bool isWhole = smg::lacksStreamNumbering(input) && !smg::isPreview(input);
  static_cast<smg::DeformationTask&>(*task).asked.deforming.inCore =
    isWhole && this->Internal->isInteractive(input);
  return task;
}

bool vtkStreamingMeshDeformation::IsForMemory(vtkPointSet& input, bool isWhole)
{
  const bool isForMemory =
    smg::isPreview(input) ? this->IsForPreview() : isWhole && this->Internal->isInteractive(input);
  if (!isForMemory)
  {
    this->Internal->Interactive.forget();
    this->Internal->OfCoarser.forget();
  }
  return isForMemory;
}

vtkSmartPointer<vtkPointSet> vtkStreamingMeshDeformation::MeshInMemory(vtkPointSet& input)
{
  const bool isCoarser = smg::isPreview(input) && input.GetNumberOfPoints() > this->DragPoints &&
                         smg::HandleArrays::holdAny(input) &&
                         smg::CoarserPreview::isPossible(input);
  return isCoarser ? this->Internal->Dragged.of(input, this->DragPoints).of(input)
                   : this->Superclass::MeshInMemory(input);
}

void vtkStreamingMeshDeformation::SpreadValues(
  vtkPointSet& input, int columns, std::vector<double>& values)
{
  this->Internal->Dragged.follow(input, columns, values);
}

std::unique_ptr<smg::JobTask> vtkStreamingMeshDeformation::MakeCoarserTask(vtkPointSet& coarser)
{
  std::unique_ptr<smg::JobTask> task = this->MakeTask(coarser);
  auto& deformation = static_cast<smg::DeformationTask&>(*task);
  deformation.interactive = &this->Internal->OfCoarser;
  deformation.needsNormals = false;
  deformation.needsHandles = true; // otherwise there is no error to estimate
  return task;
}

smg::SolveSummary vtkStreamingMeshDeformation::SolveInProcesses(
  vtkPointSet& piece, const std::function<bool(double)>& progress, std::vector<double>& values)
{
  const auto taskOf = [this](vtkPointSet& sample) { return this->MakeTask(sample); };
  return smg::deformInProcesses(piece, this->GetController(), taskOf, progress, values);
}

std::string vtkStreamingMeshDeformation::WhyStreaming()
{
  return this->GetCycles() > 0 ? "it counts V-cycles (Cycles)" : this->Superclass::WhyStreaming();
}

void vtkStreamingMeshDeformation::Deliver(
  vtkPointSet& piece, const std::vector<double>& values, vtkPointSet& output)
{
  smg::movePiece(piece,
    { .values = values,
      .columns = this->GetSummary().columns,
      .needsCellNormals = this->GetNormals() == RECOMPUTE },
    output);
  smg::HandleArrays::forgetPlaces(*output.GetPointData());
  if (!this->KeepHandleArrays)
  {
    smg::HandleArrays::removeFrom(*output.GetPointData());
  }
}

void vtkStreamingMeshDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "KeepHandleArrays: " << this->KeepHandleArrays << "\n";
  os << indent << "InteractivePoints: " << this->InteractivePoints << "\n";
  os << indent << "DragPoints: " << this->DragPoints << "\n";
  os << indent << "NumberOfBuilds: " << this->GetNumberOfBuilds() << "\n";
}
