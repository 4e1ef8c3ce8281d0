// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkRegionChain.h"

#include "Filters/vtkMeshRegion.h"

namespace smg
{

vtkAlgorithm& firstOfChain(vtkMeshRegion& region)
{
  vtkAlgorithm* first = &region;
  vtkAlgorithm* at = &region;
  while (at->GetNumberOfInputPorts() > 0 && at->GetNumberOfInputConnections(0) > 0)
  {
    at = at->GetInputAlgorithm(0, 0);
    if (vtkMeshRegion::SafeDownCast(at))
    {
      first = at;
    }
    // ParaView adds one of these after every filter.
    else if (!at->IsA("vtkPVPostFilter"))
    {
      break;
    }
  }
  return *first;
}

} // namespace smg
