// SPDX-License-Identifier: BSD-3-Clause
#include "RegisteredProxies.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

namespace smg
{
namespace
{

using Take = std::function<void(vtkSMProxy&, const std::string&)>;

class Registration : public vtkCommand
{
public:
  static Registration* New() { return new Registration; }

  void Execute(vtkObject*, unsigned long, void* data) override
  {
    const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
    if (made && made->Proxy && made->GroupName)
    {
      this->ToTake(*made->Proxy, made->GroupName);
    }
  }

  Take ToTake;
};

/** What was registered before the plugin was loaded. */
void takePresent(vtkSMSessionProxyManager* manager, const Take& take)
{
  std::vector<std::pair<vtkSmartPointer<vtkSMProxy>, std::string>> present;
  vtkNew<vtkSMProxyIterator> proxies;
  proxies->SetSessionProxyManager(manager);
  proxies->SkipPrototypesOff();
  for (proxies->Begin(); !proxies->IsAtEnd(); proxies->Next())
  {
    present.emplace_back(proxies->GetProxy(), proxies->GetGroup());
  }
  for (const auto& [proxy, group] : present)
  {
    take(*proxy, group);
  }
}

} // namespace

void forRegisteredProxies(Take take)
{
  vtkSMProxyManager* manager = vtkSMProxyManager::GetProxyManager();
  if (!manager)
  {
    return;
  }
  if (vtkSMSessionProxyManager* session = manager->GetActiveSessionProxyManager())
  {
    takePresent(session, take);
  }
  vtkNew<Registration> registration;
  registration->ToTake = std::move(take);
  manager->AddObserver(vtkCommand::RegisterEvent, registration);
}

} // namespace smg
