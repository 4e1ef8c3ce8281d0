// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Vtk/SavedInput.h"

#include "IO/Vtk/Failures.h"
#include "IO/Vtk/MeshPieceData.h"
#include "IO/Vtk/PieceInput.h"
#include "smg/Error.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <set>
#include <string>

namespace smg
{
namespace
{

/** Whether an output is made of the whole mesh before it, unless a mark says otherwise: a mesh of
 * its own, or a table on a solve. */
bool isOfWholeMesh(vtkAlgorithmOutput& output)
{
  vtkAlgorithm& filter = *output.GetProducer();
  return filter.IsA("vtkStreamingMeshPreview") || filter.IsA("vtkStreamingMeshSimplification") ||
         (filter.IsA("vtkStreamingSolver") && output.GetIndex() > 0);
}

/** The first filter before another whose output has a field array; null: none. Those in `seen` have
 * none before them. */
vtkAlgorithm* markedBefore(vtkAlgorithm& filter, const char* mark, std::set<vtkAlgorithm*>& seen)
{
  if (!seen.insert(&filter).second)
  {
    return nullptr;
  }
  for (int port = 0; port < filter.GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < filter.GetNumberOfInputConnections(port); ++k)
    {
      vtkAlgorithmOutput& before = *filter.GetInputConnection(port, k);
      vtkAlgorithm* first =
        isOfWholeMesh(before) ? nullptr : markedBefore(*before.GetProducer(), mark, seen);
      vtkDataObject* data = filter.GetInputDataObject(port, k);
      if (first || (data && data->GetFieldData()->HasArray(mark)))
      {
        return first ? first : before.GetProducer();
      }
    }
  }
  return nullptr;
}

/** The same of any filter. */
vtkAlgorithm* markedBefore(vtkAlgorithm& filter, const char* mark)
{
  std::set<vtkAlgorithm*> seen;
  return markedBefore(filter, mark, seen);
}

/** Why not to save what is made of something else than who saves it may think, in a sentence;
 * empty: there is no reason. Of tables, images and lines ParaView has writers of its own. */
std::string refusalOf(vtkAlgorithm& writer)
{
  vtkDataObject* data = writer.GetInputDataObject(0, 0);
  auto* mesh = data && (data->IsA("vtkPolyData") || data->IsA("vtkUnstructuredGrid"))
                 ? vtkPointSet::SafeDownCast(data)
                 : nullptr;
  if (!data || (mesh && isPreview(*mesh)) || PieceInput(writer, 0).isBesideMesh())
  {
    return "";
  }
  if (vtkAlgorithm* failed = markedBefore(writer, FailedName))
  {
    return "What is to be saved is made of the empty output of " + nameInPipeline(*failed) +
           ", which has failed: see its error.";
  }
  const bool isPiece = mesh && mesh->GetPointData()->GetGlobalIds();
  if (!isPiece && markedBefore(writer, PreviewOfReaderName))
  {
    return "What is to be saved is made of a preview, and not of its mesh: raise "
           "MaximumPointsInMemory of the reader, so that all of the mesh is read, or, to save what "
           "is shown, put a Streaming Mesh Preview behind the reader.";
  }
  return mesh || data->IsA("vtkCompositeDataSet")
           ? ""
           : "The input is no mesh but a " + std::string(data->GetClassName()) +
               ": connect polygonal data or an unstructured grid.";
}

} // namespace

void checkSavedInput(vtkAlgorithm& writer)
{
  if (refusalOf(writer).empty())
  {
    return;
  }
  // The filters before may have what was asked for earlier.
  try
  {
    PieceInput(writer, 0).update(0, 1, false);
  }
  catch (const InputFailed&)
  {
    throw;
  }
  catch (const Error&)
  {
    // Of blocks; there is the same reason as before, or whoever writes throws it again.
  }
  if (const std::string reason = refusalOf(writer); !reason.empty())
  {
    throw Error(reason);
  }
}

} // namespace smg
