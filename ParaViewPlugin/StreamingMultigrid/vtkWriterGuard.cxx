// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWriterGuard.h"

#include "IO/vtkFailures.h"
#include "IO/vtkMeshPieceData.h"
#include "vtkRegisteredProxies.h"

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVProxyDefinitionIterator.h"
#include "vtkPVXMLElement.h"
#include "vtkSMDomain.h"
#include "vtkSMInputProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyDefinitionManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace
{

/** Data with a field array of a certain name, or without any of some. It is added to prototypes of
 * writers, which ParaView asks whether they take some data: named in XML, its class would be an
 * error on a client that has not loaded the plugin, unlike its server. */
class vtkSMMarkDomain : public vtkSMDomain
{
public:
  static vtkSMMarkDomain* New();
  vtkTypeMacro(vtkSMMarkDomain, vtkSMDomain);

  int IsInDomain(vtkSMProperty* property) override
  {
    const vtkSMUncheckedPropertyHelper input(property);
    for (unsigned int k = 0; k < input.GetNumberOfElements(); ++k)
    {
      auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(k));
      vtkPVDataInformation* data =
        source ? source->GetDataInformation(input.GetOutputPort(k)) : nullptr;
      const auto has = [data](const std::string& name)
      { return data && data->GetArrayInformation(name.c_str(), vtkDataObject::FIELD); };
      if (std::ranges::any_of(this->Refused, has) || !std::ranges::all_of(this->Required, has))
      {
        return NOT_IN_DOMAIN;
      }
    }
    return IN_DOMAIN;
  }

  std::vector<std::string> Required, Refused;
};

vtkStandardNewMacro(vtkSMMarkDomain);

const char* const DomainName = "marks";

/** Of the writers of this plugin. */
bool isOurs(const char* className)
{
  return className && std::string_view(className) == "vtkStreamingMeshWriter";
}

std::vector<std::string> suffixesIn(vtkPVXMLElement* hints)
{
  vtkPVXMLElement* factory = hints ? hints->FindNestedElementByName("WriterFactory") : nullptr;
  std::istringstream text(factory ? factory->GetAttributeOrEmpty("extensions") : "");
  std::vector<std::string> suffixes;
  for (std::string suffix; text >> suffix;)
  {
    suffixes.push_back(suffix);
  }
  return suffixes;
}

/** Adds the suffixes of all writers of others to those of a writer that only explains why they do
 * not write; those of our other writers are left to these. */
void addSuffixes(vtkSMProxy& writer)
{
  vtkPVXMLElement* hints = writer.GetHints();
  vtkPVXMLElement* factory = hints ? hints->FindNestedElementByName("WriterFactory") : nullptr;
  if (!factory || !factory->GetAttribute("others"))
  {
    return;
  }
  std::set<std::string> written, wanted;
  const auto definitions = vtkSmartPointer<vtkPVProxyDefinitionIterator>::Take(
    writer.GetSessionProxyManager()->GetProxyDefinitionManager()->NewSingleGroupIterator(
      "writers"));
  for (definitions->InitTraversal(); !definitions->IsDoneWithTraversal();
       definitions->GoToNextItem())
  {
    vtkPVXMLElement* definition = definitions->GetProxyDefinition();
    vtkPVXMLElement* ofWriter = definitions->GetProxyHints();
    vtkPVXMLElement* its = ofWriter ? ofWriter->FindNestedElementByName("WriterFactory") : nullptr;
    if (!its || its->GetAttribute("others"))
    {
      continue;
    }
    const std::vector<std::string> suffixes = suffixesIn(ofWriter);
    (isOurs(definition ? definition->GetAttribute("class") : nullptr) ? written : wanted)
      .insert(suffixes.begin(), suffixes.end());
  }
  std::erase_if(wanted, [&](const std::string& suffix) { return written.contains(suffix); });
  const std::vector<std::string> own = suffixesIn(hints);
  wanted.insert(own.begin(), own.end());
  std::string text;
  for (const std::string& suffix : wanted)
  {
    text += (text.empty() ? "" : " ") + suffix;
  }
  factory->SetAttribute("extensions", text.c_str());
}

void guard(vtkSMProxy& writer)
{
  auto* input = vtkSMInputProperty::SafeDownCast(writer.GetProperty("Input"));
  if (!input || input->GetDomain(DomainName))
  {
    return;
  }
  const std::vector<std::string> marks{ smg::PreviewOfReaderName, smg::FailedName };
  const vtkNew<vtkSMMarkDomain> domain;
  if (!isOurs(writer.GetVTKClassName()))
  {
    domain->Refused = marks;
  }
  else
  {
    // Of a client without this plugin, a domain of that name knows the mark by its components.
    std::ranges::copy_if(marks, std::back_inserter(domain->Required),
      [input](const std::string& mark) { return input->GetDomain(mark.c_str()) != nullptr; });
    addSuffixes(writer);
  }
  input->AddDomain(DomainName, domain);
}

} // namespace

void smg::guardWriters()
{
  forRegisteredProxies(
    [](vtkSMProxy& proxy, const std::string& group)
    {
      if (group == "writers_prototypes" || group == "extract_writers_prototypes")
      {
        guard(proxy);
      }
    });
}
