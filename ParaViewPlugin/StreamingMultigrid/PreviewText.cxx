// SPDX-License-Identifier: BSD-3-Clause
#include "PreviewText.h"

#include "IO/Vtk/MeshPieceData.h"
#include "RegisteredProxies.h"
#include "Solver/Core/Text.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace smg
{
namespace
{

vtkPVDataInformation* dataOf(vtkSMProxy* proxy, unsigned int port)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  return source ? source->GetDataInformation(port) : nullptr;
}

/** The points of the mesh of which the data are a preview, or what filters make of one; 0 of other
 * data. */
std::int64_t pointsBehind(vtkPVDataInformation* data)
{
  const auto arrayOf = [data](const char* name)
  { return data ? data->GetArrayInformation(name, vtkDataObject::FIELD) : nullptr; };
  vtkPVArrayInformation* count = arrayOf(FullNumberOfPointsName);
  return arrayOf(PreviewName) && count ? std::llround(count->GetComponentRange(0)[1]) : 0;
}

/** What is to be said of the output of a filter; empty: nothing. */
std::string textOf(vtkSMProxy* source, unsigned int port)
{
  const std::int64_t all = pointsBehind(dataOf(source, port));
  if (all == 0)
  {
    return "";
  }
  // A slice has fewer points than the preview that is sliced.
  while (source && !source->GetProperty("FullNumberOfPoints"))
  {
    const vtkSMPropertyHelper input(source, "Input", true);
    port = input.GetOutputPort();
    source = input.GetAsProxy();
  }
  vtkPVDataInformation* preview = dataOf(source, port);
  return pointsBehind(preview) == all
           ? groupedDigits(preview->GetNumberOfPoints()) + " of " + groupedDigits(all) + " points"
           : "A preview of " + groupedDigits(all) + " points";
}

/** Of all that a view shows, a line for each mesh. */
std::string textOf(vtkSMProxy& view)
{
  std::set<std::string> lines;
  const vtkSMPropertyHelper shown(&view, "Representations", true);
  for (unsigned int k = 0; k < shown.GetNumberOfElements(); ++k)
  {
    vtkSMProxy* representation = shown.GetAsProxy(k);
    if (representation && vtkSMPropertyHelper(representation, "Visibility", true).GetAsInt() != 0)
    {
      const vtkSMPropertyHelper input(representation, "Input", true);
      lines.insert(textOf(input.GetAsProxy(), input.GetOutputPort()));
    }
  }
  lines.erase("");
  std::string text;
  for (const std::string& line : lines)
  {
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

/** The text of a view. ParaView's own tools are shown in the same way: neither the pipeline nor a
 * state that is saved has it. */
struct ViewText
{
  vtkWeakPointer<vtkSMProxy> View;
  vtkWeakPointer<vtkSMProxy> Line; ///< which the view keeps; null: nothing had to be said yet
  std::string Shown;

  void show(const std::string& text)
  {
    if (this->Line ? text == this->Shown : text.empty() || !this->makeLine())
    {
      return;
    }
    this->Shown = text;
    vtkSMPropertyHelper(this->Line, "Text").Set(text.c_str());
    vtkSMPropertyHelper(this->Line, "Visibility").Set(text.empty() ? 0 : 1);
    this->Line->UpdateVTKObjects();
  }

private:
  bool makeLine()
  {
    constexpr int LowerCenter = 3, FontSize = 10; // the Where of a solve is above
    const auto line =
      vtkSmartPointer<vtkSMProxy>::Take(this->View->GetSessionProxyManager()->NewProxy(
        "representations", "TextWidgetRepresentation"));
    if (!line)
    {
      return false;
    }
    vtkNew<vtkSMParaViewPipelineController>()->InitializeProxy(line);
    vtkSMPropertyHelper(line, "Enabled").Set(0); // it cannot be dragged
    vtkSMPropertyHelper(line, "WindowLocation").Set(LowerCenter);
    vtkSMPropertyHelper(line, "FontSize").Set(FontSize);
    line->UpdateVTKObjects();
    vtkSMPropertyHelper(this->View, "HiddenRepresentations").Add(line);
    this->View->UpdateVTKObjects();
    this->Line = line;
    return true;
  }
};

/** Watches all views. */
class PreviewTexts : public vtkCommand
{
public:
  static PreviewTexts* New() { return new PreviewTexts; }

  void watch(vtkSMProxy& view)
  {
    std::erase_if(this->Texts, [](const ViewText& text) { return !text.View; });
    const bool isWatched = std::ranges::any_of(
      this->Texts, [&view](const ViewText& text) { return text.View == &view; });
    if (!isWatched)
    {
      this->Texts.push_back({ &view, nullptr, "" });
      view.AddObserver(vtkCommand::UpdateDataEvent, this);
    }
  }

  /** After a view has updated what it shows, before it renders. */
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    // Of several processes that run the same script each knows its own part of the data, but all
    // must have the same proxies.
    if (vtkProcessModule::GetProcessModule()->GetSymmetricMPIMode())
    {
      return;
    }
    for (ViewText& text : this->Texts)
    {
      if (text.View == caller)
      {
        text.show(textOf(*text.View));
      }
    }
  }

private:
  std::vector<ViewText> Texts;
};

} // namespace

void nameShownPreviews()
{
  forRegisteredProxies(
    [texts = vtkSmartPointer<PreviewTexts>::New()](vtkSMProxy& proxy, const std::string& group)
    {
      if (group == "views" && proxy.IsA("vtkSMRenderViewProxy"))
      {
        texts->watch(proxy);
      }
    });
}

} // namespace smg
