// SPDX-License-Identifier: BSD-3-Clause
#include "WriterGuard.h"

#include "IO/Vtk/Failures.h"
#include "IO/Vtk/MeshPieceData.h"
#include "RegisteredProxies.h"

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVProxyDefinitionIterator.h"
#include "vtkPVXMLElement.h"
#include "vtkSMDomain.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyDefinitionManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace
{

/** An output in the pipeline. */
struct Output
{
  vtkSMProxy* Source;
  unsigned int Port;

  vtkPVDataInformation* data() const
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(this->Source);
    return source ? source->GetDataInformation(this->Port) : nullptr;
  }

  /** Whether its data have a field array. */
  bool has(const std::string& name) const
  {
    vtkPVDataInformation* information = this->data();
    return information && information->GetArrayInformation(name.c_str(), vtkDataObject::FIELD);
  }

  bool isMesh() const
  {
    vtkPVDataInformation* information = this->data();
    // Of blocks, the type is that of one of them.
    const bool isSingle = information && !information->IsCompositeDataSet();
    const int type = isSingle ? information->GetDataSetType() : -1;
    return type == VTK_POLY_DATA || type == VTK_UNSTRUCTURED_GRID;
  }

  /** Whether it is made by this plugin of the whole mesh before it, unless a mark says otherwise:
   * a mesh of its own, or a table on a solve. */
  bool isOfWholeMesh() const
  {
    const std::string_view name(
      this->Source->GetVTKClassName() ? this->Source->GetVTKClassName() : "");
    vtkSMProperty* error = this->Source->GetProperty("Error");
    return name == "vtkStreamingMeshPreview" || name == "vtkStreamingMeshSimplification" ||
           (this->Port > 0 && error && error->GetInformationOnly());
  }
};

/** Whether its data, or those that they are made of, have a field array: tables, and what some
 * filters make of a mesh, lose those of their input. */
bool isMadeOf(const Output& output, const std::string& mark, std::set<vtkSMProxy*> seen = {})
{
  if (!output.Source || output.has(mark))
  {
    return output.Source != nullptr;
  }
  if (output.isOfWholeMesh() || !seen.insert(output.Source).second)
  {
    return false;
  }
  const auto properties =
    vtkSmartPointer<vtkSMPropertyIterator>::Take(output.Source->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    auto* input = vtkSMInputProperty::SafeDownCast(properties->GetProperty());
    for (unsigned int k = 0; input && k < input->GetNumberOfProxies(); ++k)
    {
      if (isMadeOf({ input->GetProxy(k), input->GetOutputPortForConnection(k) }, mark, seen))
      {
        return true;
      }
    }
  }
  return false;
}

/** What a writer takes: data with all of some marks, made of data with any of some, or of data with
 * none. It is added to prototypes of writers, which ParaView asks whether they take some data:
 * named in XML, its class would be an error on a client that has not loaded the plugin, unlike its
 * server. */
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
      const Output output{ input.GetAsProxy(k), input.GetOutputPort(k) };
      const auto has = [&](const std::string& mark) { return output.has(mark); };
      const auto isOf = [&](const std::string& mark) { return isMadeOf(output, mark); };
      // Our other writers take meshes with marks.
      const bool isForOthers = output.isMesh() && std::ranges::any_of(this->Origins, has);
      if (std::ranges::any_of(this->Refused, isOf) || !std::ranges::all_of(this->Required, has) ||
          (!this->Origins.empty() && (isForOthers || std::ranges::none_of(this->Origins, isOf))))
      {
        return NOT_IN_DOMAIN;
      }
    }
    return IN_DOMAIN;
  }

  std::vector<std::string> Required, Refused, Origins;
};

vtkStandardNewMacro(vtkSMMarkDomain);

const char* const DomainName = "marks";

/** Of the writers of this plugin. */
bool isOurs(const char* className)
{
  return className && std::string_view(className) == "vtkStreamingMeshWriter";
}

/** Of these, of that which only explains why no table or image is written. */
bool isForOtherData(vtkSMProxy& writer)
{
  return std::string_view(writer.GetXMLName()) == "WholeMeshRefusal";
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
 * not write; those of our other writers are left to these, unless it is for what none of them
 * takes. */
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
    if (!its || (its->GetAttribute("others") && !isForOtherData(writer)))
    {
      continue;
    }
    const std::vector<std::string> suffixes = suffixesIn(ofWriter);
    (isOurs(definition ? definition->GetAttribute("class") : nullptr) ? written : wanted)
      .insert(suffixes.begin(), suffixes.end());
  }
  if (isForOtherData(writer))
  {
    wanted.insert(written.begin(), written.end());
  }
  else
  {
    std::erase_if(wanted, [&](const std::string& suffix) { return written.contains(suffix); });
  }
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
  else if (isForOtherData(writer))
  {
    domain->Origins = marks;
    addSuffixes(writer);
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
