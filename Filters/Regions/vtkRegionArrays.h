// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/vtkHeldPoints.h"
#include "smg/Region.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** The field array of strings with the names of the point arrays that Mesh Regions have added. */
inline constexpr const char* MeshRegionsName = "MeshRegions";

/** Adds the held points to the region `name` of the mesh, a point array that is 1 in the region.
 * Throws Error if the mesh has an array of that name which is no region. */
void addToRegion(vtkPointSet& mesh, const std::string& name, const HeldPoints& held);

/** The regions of the mesh, and the places that `text`, the property `property` of a filter, lists
 * in JSON, if there is one. Throws Error. */
std::vector<Where> placesOn(vtkPointSet& mesh, const char* text, const char* property);

/** Takes regions without a point of a preview out of `places`: those of the mesh, which may have
 * some, lie between its points. */
void dropEmptyRegions(vtkPointSet& preview, std::vector<Where>& places);

} // namespace smg
