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

/** An unused name for the point array of another condition, which is not 0 in its region. */
std::string newMaskName(vtkPointSet& mesh);

/** Appends a condition to those of the mesh. */
void addCondition(vtkPointSet& mesh, const std::string& text);

/** Removes all conditions and their mask arrays. */
void removeConditions(vtkPointSet& mesh);

/** The number of conditions of the mesh. */
int countConditions(vtkPointSet& mesh);

/** Adds the conditions of a mesh to a problem. Throws Error if one is not a valid part of a
 * problem. */
void applyConditions(vtkPointSet& mesh, ProblemDescription& problem);

} // namespace smg
