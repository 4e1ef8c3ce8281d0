// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreshOutcomes.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSourceProxy.h"

namespace smg
{
namespace
{

/** After an update of a proxy. */
void refresh(vtkObject* caller, unsigned long, void*, void*)
{
  auto* proxy = vtkSMProxy::SafeDownCast(caller);
  for (const char* name : { "Outcome", "Notes", "Error" })
  {
    if (vtkSMProperty* property = proxy->GetProperty(name))
    {
      proxy->UpdatePropertyInformation(property);
    }
  }
}

/** After a proxy is made. */
void watch(vtkObject*, unsigned long, void*, void* data)
{
  static const vtkNew<vtkCallbackCommand> command;
  command->SetCallback(refresh);
  const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
  auto* source = made ? vtkSMSourceProxy::SafeDownCast(made->Proxy) : nullptr;
  vtkSMProperty* outcome = source ? source->GetProperty("Outcome") : nullptr;
  const bool isOurs = outcome && outcome->GetInformationOnly();
  // A renamed proxy is registered again.
  if (isOurs && !source->HasObserver(vtkCommand::UpdateDataEvent, command))
  {
    source->AddObserver(vtkCommand::UpdateDataEvent, command);
  }
}

} // namespace

void refreshOutcomes()
{
  if (vtkSMProxyManager* manager = vtkSMProxyManager::GetProxyManager())
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetCallback(watch);
    manager->AddObserver(vtkCommand::RegisterEvent, command);
  }
}

} // namespace smg
