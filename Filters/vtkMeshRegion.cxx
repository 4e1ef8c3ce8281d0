// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkMeshRegion.h"

#include "Filters/Regions/HeldPoints.h"
#include "Filters/Regions/RegionArrays.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <string>

vtkStandardNewMacro(vtkMeshRegion);

vtkMeshRegion::vtkMeshRegion()
{
  this->SetRegionName("RegionMask");
}

vtkMeshRegion::~vtkMeshRegion() = default;

void vtkMeshRegion::Check()
{
  if (this->RegionName.empty())
  {
    throw smg::Error("The region has no name: set RegionName, the name of its array.");
  }
  if (smg::isReservedColumn(this->RegionName) || this->RegionName == smg::OriginalIdName)
  {
    throw smg::Error("The name " + this->RegionName +
                     " is that of an array that every piece has: choose another RegionName.");
  }
}

void vtkMeshRegion::Deliver(vtkPointSet& piece, const smg::HeldPoints& held, vtkPointSet& output)
{
  output.ShallowCopy(&piece);
  const bool replaces = smg::addToRegion(output, this->RegionName, held);
  this->WarnOfReplaced(
    replaces ? "The array " + this->RegionName +
                 " of the input, which no Mesh Region before this one has made, is replaced by the "
                 "region: choose another RegionName to keep both."
             : "");
  // Views show the region.
  output.GetPointData()->SetActiveScalars(this->RegionName.c_str());
}

void vtkMeshRegion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RegionName: " << smg::textOrNone(this->RegionName) << "\n";
}
