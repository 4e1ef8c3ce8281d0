// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Regions/ConditionNames.h"
#include "Filters/Regions/HeldPoints.h"
#include "smg/ProblemDescription.h"
#include "smg/Region.h"

#include <string>
#include <vector>

class vtkPointSet;

namespace smg
{

/** The field array of strings with the names of the point arrays that Mesh Regions have added. */
inline constexpr const char* MeshRegionsName = "MeshRegions";

/** Adds the held points to the region `name` of the mesh, a point array that is 1 in the region. An
 * array of that name which looks like one, as that of a saved result, but is of no Mesh Region of
 * the pipeline, is replaced. Throws Error if the mesh has another array of that name.
 * @return whether an array was replaced */
bool addToRegion(vtkPointSet& mesh, const std::string& name, const HeldPoints& held);

/** The regions of the mesh, and the places that `text`, the property `property` of a filter, lists
 * in JSON, if there is one. Throws Error. */
std::vector<Where> placesOn(vtkPointSet& mesh, const char* text, const char* property);

/** Takes regions without a point of a preview out of `places`: those of the mesh, which may have
 * some, lie between its points. */
void dropEmptyRegions(vtkPointSet& preview, std::vector<Where>& places);

/** The conditions of a mesh: the field array `MeshConditions` of strings, each a part of a problem
 * in the JSON of a problem file (see smg/DescriptionFiles.h). */
inline constexpr const char* MeshConditionsName = "MeshConditions";

/** The field array of strings with the names of the point arrays that conditions have added. */
inline constexpr const char* MeshConditionArraysName = "MeshConditionArrays";

/** Adds the point array of another condition, unsigned char and 0, and returns its name, which was
 * unused. */
std::string addMask(vtkPointSet& mesh);

/** Appends a condition to those of the mesh. */
void addCondition(vtkPointSet& mesh, const std::string& text);

/** Whether the point array is one that a condition has added. */
bool isOfCondition(vtkPointSet& mesh, const std::string& array);

/** Removes all conditions and the arrays that they have added. */
void removeConditions(vtkPointSet& mesh);

/** The number of conditions of the mesh. */
int countConditions(vtkPointSet& mesh);

/** Adds the conditions of a mesh to a problem, and returns which entries they have become. Throws
 * Error if one is not a valid part of a problem. */
ConditionNames applyConditions(vtkPointSet& mesh, ProblemDescription& problem);

} // namespace smg
