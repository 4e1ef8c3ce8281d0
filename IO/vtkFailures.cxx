// SPDX-License-Identifier: BSD-3-Clause
#include "IO/vtkFailures.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkUnsignedCharArray.h"

#include <string_view>

namespace smg
{
namespace
{

constexpr const char* FailedName = "Failed";
/** See BigMeshWriter.xml. */
constexpr int FailedComponents = 19;

void showAllButFailedRequests(vtkObject*, unsigned long, void*, void* text)
{
  const auto* message = static_cast<const char*>(text);
  if (std::string_view(message).find("returned failure for request") == std::string_view::npos)
  {
    vtkOutputWindow::GetInstance()->DisplayErrorText(message);
  }
}

vtkMTimeType pipelineTimeOf(vtkAlgorithm& algorithm)
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(algorithm.GetExecutive());
  return pipeline ? pipeline->GetPipelineMTime() : algorithm.GetMTime();
}

} // namespace

void markAsFailed(vtkDataObject& data)
{
  vtkNew<vtkUnsignedCharArray> mark;
  mark->SetName(FailedName);
  mark->SetNumberOfComponents(FailedComponents);
  mark->SetNumberOfTuples(1);
  mark->Fill(1);
  data.GetFieldData()->AddArray(mark);
}

bool isFailed(vtkDataObject* data)
{
  return data && data->GetFieldData() && data->GetFieldData()->HasArray(FailedName);
}

void Failures::show(vtkAlgorithm& algorithm, const std::string& sentence)
{
  this->Error = sentence;
  this->quieten(algorithm);
  const vtkMTimeType now = pipelineTimeOf(algorithm);
  if (this->Last == sentence && this->PipelineTime == now &&
      !algorithm.HasObserver(vtkCommand::ErrorEvent))
  {
    return;
  }
  this->Last = sentence;
  this->PipelineTime = now;
  vtkErrorWithObjectMacro(&algorithm, << sentence);
}

void Failures::showToObservers(vtkAlgorithm& algorithm, const std::string& sentence)
{
  this->Error = sentence;
  this->quieten(algorithm);
  if (algorithm.HasObserver(vtkCommand::ErrorEvent))
  {
    vtkErrorWithObjectMacro(&algorithm, << sentence);
  }
}

void Failures::quieten(vtkAlgorithm& algorithm)
{
  vtkExecutive* executive = algorithm.GetExecutive();
  if (this->Quiet == executive || executive->HasObserver(vtkCommand::ErrorEvent))
  {
    return;
  }
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(showAllButFailedRequests);
  executive->AddObserver(vtkCommand::ErrorEvent, command);
  this->Quiet = executive;
}

} // namespace smg
