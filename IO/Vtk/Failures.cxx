// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/Failures.h"

#include "IO/Vtk/FieldMarks.h"
#include "IO/Vtk/PropertyNames.h"
#include "Solver/Core/Text.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace smg
{
namespace
{

vtkMTimeType pipelineTimeOf(vtkAlgorithm& algorithm)
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(algorithm.GetExecutive());
  return pipeline ? pipeline->GetPipelineMTime() : algorithm.GetMTime();
}

} // namespace

void markAsFailed(vtkDataObject& data)
{
  addMark(data, FailedName, FailedComponents);
}

bool isFailed(vtkDataObject* data)
{
  return data && data->GetFieldData() && data->GetFieldData()->HasArray(FailedName);
}

void completeMesh(vtkDataObject& data)
{
  auto* mesh = vtkPointSet::SafeDownCast(&data);
  if (mesh && !mesh->GetPoints())
  {
    mesh->SetPoints(vtkNew<vtkPoints>());
  }
  if (!mesh || mesh->GetNumberOfCells() > 0)
  {
    return;
  }
  if (auto* surface = vtkPolyData::SafeDownCast(mesh))
  {
    surface->SetVerts(vtkNew<vtkCellArray>());
    surface->SetLines(vtkNew<vtkCellArray>());
    surface->SetPolys(vtkNew<vtkCellArray>());
    surface->SetStrips(vtkNew<vtkCellArray>());
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    grid->SetCells(vtkNew<vtkUnsignedCharArray>(), vtkNew<vtkCellArray>());
  }
}

Failures::~Failures()
{
  this->watch(nullptr);
}

void Failures::begin()
{
  this->Error.clear();
  this->IsRefused = false;
}

bool Failures::isLast(vtkAlgorithm& algorithm) const
{
  return this->Ended.GetMTime() > 0 && this->Ended.GetMTime() >= pipelineTimeOf(algorithm);
}

void Failures::show(vtkAlgorithm& algorithm, const std::string& sentence)
{
  this->Error = withProperties(oneLine(sentence), algorithm);
  const vtkMTimeType now = pipelineTimeOf(algorithm);
  if (this->Last == this->Error && this->PipelineTime == now &&
      !algorithm.HasObserver(vtkCommand::ErrorEvent))
  {
    return;
  }
  this->Last = this->Error;
  this->PipelineTime = now;
  vtkErrorWithObjectMacro(&algorithm, << this->Error);
}

void Failures::reportToObservers(vtkAlgorithm& algorithm, const std::string& sentence)
{
  this->Error = withProperties(oneLine(sentence), algorithm);
  if (algorithm.HasObserver(vtkCommand::ErrorEvent))
  {
    vtkErrorWithObjectMacro(&algorithm, << this->Error);
  }
}

int Failures::refuse(vtkAlgorithm& algorithm)
{
  vtkExecutive* executive = algorithm.GetExecutive();
  this->IsRefused = true;
  if (this->Watched != executive && !executive->HasObserver(vtkCommand::ErrorEvent))
  {
    this->watch(executive);
  }
  return 0;
}

void Failures::watch(vtkExecutive* executive)
{
  if (this->Watched)
  {
    this->Watched->RemoveObserver(this->OfExecutive);
  }
  this->Watched = executive;
  if (executive)
  {
    this->OfExecutive->SetClientData(this);
    this->OfExecutive->SetCallback(display);
    executive->AddObserver(vtkCommand::ErrorEvent, this->OfExecutive);
  }
}

void Failures::display(vtkObject*, unsigned long, void* self, void* text)
{
  auto* failures = static_cast<Failures*>(self);
  if (!failures->IsRefused)
  {
    vtkOutputWindow::GetInstance()->DisplayErrorText(static_cast<const char*>(text));
  }
  failures->IsRefused = false;
}

} // namespace smg
