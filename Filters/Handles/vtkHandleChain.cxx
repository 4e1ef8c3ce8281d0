// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Handles/vtkHandleChain.h"

#include "Filters/vtkMeshHandle.h"

namespace smg
{

vtkAlgorithm& firstOfChain(vtkMeshHandle& handle)
{
  vtkAlgorithm* first = &handle;
  vtkAlgorithm* at = &handle;
  while (at->GetNumberOfInputPorts() > 0 && at->GetNumberOfInputConnections(0) > 0)
  {
    at = at->GetInputAlgorithm(0, 0);
    if (vtkMeshHandle::SafeDownCast(at))
    {
      first = at;
    }
    // ParaView puts one of these behind every filter.
    else if (!at->IsA("vtkPVPostFilter"))
    {
      break;
    }
  }
  return *first;
}

} // namespace smg
