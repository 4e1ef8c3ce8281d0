// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMultiEngineSolver.h"

#include "Filters/Processes/MemoryFit.h"
#include "IO/Vtk/PropertyRange.h"

#include "vtkMultiProcessController.h"

void vtkMultiEngineSolver::CheckRanges() const
{
  this->Superclass::CheckRanges();
  smg::requireInRange({ { "Engine", this->Engine, STREAMING, AUTOMATIC_ENGINE } });
}

bool vtkMultiEngineSolver::IsForProcesses(vtkPointSet& piece, bool isAlone)
{
  std::string& note = this->EngineNote;
  note.clear();
  if (this->Engine == STREAMING)
  {
    return false;
  }
  if (isAlone)
  {
    note = "the streaming engine has solved, since process 0 alone answers streamed requests";
    return false;
  }
  if (this->Engine == DISTRIBUTED)
  {
    return true;
  }
  smg::MemoryFit verdict{ false, this->WhyStreaming() };
  if (verdict.reason.empty())
  {
    vtkMultiProcessController* controller = this->GetController();
    verdict = controller && controller->GetNumberOfProcesses() > 1
                ? smg::estimateMemoryFit(piece, controller, this->GetUsualColumns())
                : smg::MemoryFit{ false, "there is one process" };
  }
  note = (verdict.fits ? "the distributed engine was chosen, since "
                       : "the streaming engine was chosen, since ") +
         verdict.reason;
  return verdict.fits;
}

std::string vtkMultiEngineSolver::WhyStreaming()
{
  const char* checkpoint = this->GetCheckpointDirectory();
  return checkpoint && *checkpoint ? "it has checkpoints (CheckpointDirectory)" : "";
}

void vtkMultiEngineSolver::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  constexpr const char* names[] = { "streaming", "distributed", "automatic" };
  os << indent << "Engine: " << smg::printedChoice(names, this->Engine) << "\n";
}
