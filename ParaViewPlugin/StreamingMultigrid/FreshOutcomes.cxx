// SPDX-License-Identifier: BSD-3-Clause
#include "FreshOutcomes.h"

#include "RegisteredProxies.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"

namespace smg
{
namespace
{

/** After an update of a proxy. */
void refresh(vtkObject* caller, unsigned long, void*, void*)
{
  auto* proxy = vtkSMProxy::SafeDownCast(caller);
  for (const char* name : { "Outcome", "Notes", "Error", "HeldBounds" })
  {
    if (vtkSMProperty* property = proxy->GetProperty(name))
    {
      proxy->UpdatePropertyInformation(property);
    }
  }
}

void watch(vtkSMProxy& proxy)
{
  static const vtkNew<vtkCallbackCommand> command;
  command->SetCallback(refresh);
  auto* source = vtkSMSourceProxy::SafeDownCast(&proxy);
  vtkSMProperty* outcome = source ? source->GetProperty("Outcome") : nullptr;
  const bool isOurs = outcome && outcome->GetInformationOnly();
  if (isOurs && !source->HasObserver(vtkCommand::UpdateDataEvent, command))
  {
    source->AddObserver(vtkCommand::UpdateDataEvent, command);
  }
}

} // namespace

void refreshOutcomes()
{
  forRegisteredProxies([](vtkSMProxy& proxy, const std::string&) { watch(proxy); });
}

} // namespace smg
