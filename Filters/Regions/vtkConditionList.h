// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/ProblemDescription.h"

#include <string>

class vtkPointSet;

namespace smg
{

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

/** Removes all conditions and the arrays that they have added. */
void removeConditions(vtkPointSet& mesh);

/** The number of conditions of the mesh. */
int countConditions(vtkPointSet& mesh);

/** Adds the conditions of a mesh to a problem. Throws Error if one is not a valid part of a
 * problem. */
void applyConditions(vtkPointSet& mesh, ProblemDescription& problem);

} // namespace smg
