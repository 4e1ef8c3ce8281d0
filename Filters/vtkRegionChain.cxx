// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkRegionChain.h"

#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkRegionFilter.h"
#include "IO/vtkStreamingMeshKeys.h"
#include "IO/vtkStreamingMeshReader.h"

#include "vtkDataArraySelection.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"

#include <algorithm>

namespace smg
{
namespace
{

/** The filter before this one, apart from those that ParaView adds after every filter; null if
 * there is none. */
vtkAlgorithm* before(vtkAlgorithm& filter)
{
  vtkAlgorithm* at = &filter;
  do
  {
    const bool isConnected =
      at->GetNumberOfInputPorts() > 0 && at->GetNumberOfInputConnections(0) > 0;
    at = isConnected ? at->GetInputAlgorithm(0, 0) : nullptr;
  } while (at && at->IsA("vtkPVPostFilter"));
  return at;
}

} // namespace

vtkAlgorithm& firstOfChain(vtkRegionFilter& region)
{
  vtkAlgorithm* first = &region;
  while (vtkAlgorithm* next = vtkRegionFilter::SafeDownCast(before(*first)))
  {
    first = next;
  }
  return *first;
}

std::filesystem::path unchangedFile(vtkAlgorithm& filter, const std::set<std::string>& names)
{
  vtkAlgorithm* at = before(filter);
  while (at && vtkMeshCondition::SafeDownCast(at))
  {
    at = before(*at);
  }
  auto* reader = vtkStreamingMeshReader::SafeDownCast(at);
  const auto isRead = [reader](const std::string& name)
  {
    return reader->GetPointDataArraySelection()->ArrayIsEnabled(name.c_str()) ||
           reader->GetCellDataArraySelection()->ArrayIsEnabled(name.c_str());
  };
  if (!reader || !std::ranges::all_of(names, isRead))
  {
    return {};
  }
  const char* file = reader->GetOutputInformation(0)->Get(vtkStreamingMeshKeys::STREAM_FILE());
  return file ? file : "";
}

} // namespace smg
