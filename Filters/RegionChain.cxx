// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/RegionChain.h"

#include "Filters/vtkMeshCondition.h"
#include "Filters/vtkRegionFilter.h"
#include "IO/Vtk/PieceInput.h"
#include "IO/Vtk/vtkStreamingMeshKeys.h"
#include "IO/Vtk/vtkStreamingMeshReader.h"
#include "smg/Error.h"

#include "vtkDataArraySelection.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"

#include <algorithm>
#include <string>

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

/** Calls f(connected filter, whether it is one of several at its port) for all before this one. */
template <class F>
void visitInputs(vtkAlgorithm& filter, F&& f)
{
  for (int port = 0; port < filter.GetNumberOfInputPorts(); ++port)
  {
    const int count = filter.GetNumberOfInputConnections(port);
    for (int k = 0; k < count; ++k)
    {
      if (vtkAlgorithm* input = filter.GetInputAlgorithm(port, k))
      {
        f(*input, count > 1);
      }
    }
  }
}

bool hasCondition(vtkAlgorithm& filter)
{
  bool has = filter.IsA("vtkMeshCondition");
  visitInputs(filter, [&has](vtkAlgorithm& input, bool) { has = has || hasCondition(input); });
  return has;
}

/** Whether the pieces of the reader have the required columns, and no other one is switched off
 * that counts: the file has that. */
bool readsAll(vtkStreamingMeshReader& reader, const PieceColumns& columns)
{
  vtkDataArraySelection* const sides[] = { reader.GetPointDataArraySelection(),
    reader.GetCellDataArraySelection() };
  const auto isRead = [&sides](const std::string& name)
  {
    return std::ranges::any_of(
      sides, [&](vtkDataArraySelection* side) { return side->ArrayIsEnabled(name.c_str()) != 0; });
  };
  const auto counts = [&columns](const std::string& name)
  { return columns.all || columns.required.contains(name) || columns.optional.contains(name); };
  for (vtkDataArraySelection* side : sides)
  {
    for (int k = 0; k < side->GetNumberOfArrays(); ++k)
    {
      const char* name = side->GetArrayName(k);
      if (!side->ArrayIsEnabled(name) && counts(name))
      {
        return false;
      }
    }
  }
  return std::ranges::all_of(columns.required, isRead);
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

void requireConditionsAfterJoins(vtkAlgorithm& filter)
{
  visitInputs(filter,
    [&filter](vtkAlgorithm& input, bool isOneOfSeveral)
    {
      if (isOneOfSeveral && hasCondition(input))
      {
        throw Error("Mesh Conditions do not survive the joining of meshes by " +
                    nameInPipeline(filter) + ": put them behind that filter.");
      }
      requireConditionsAfterJoins(input);
    });
}

StreamFile unchangedFile(vtkAlgorithm& filter, const PieceColumns& columns)
{
  vtkAlgorithm* at = before(filter);
  while (!columns.all && at && vtkMeshCondition::SafeDownCast(at))
  {
    at = before(*at);
  }
  auto* reader = vtkStreamingMeshReader::SafeDownCast(at);
  if (!reader || !reader->IsFileUnchanged() || !readsAll(*reader, columns))
  {
    return {};
  }
  vtkInformation* info = reader->GetOutputInformation(0);
  const auto text = [info](vtkInformationStringKey* key)
  {
    const char* found = info->Get(key);
    return std::string(found ? found : "");
  };
  return { text(vtkStreamingMeshKeys::STREAM_FILE()),
    text(vtkStreamingMeshKeys::STREAM_FINGERPRINT()) };
}

} // namespace smg
