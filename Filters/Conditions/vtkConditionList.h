// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/ProblemDescription.h"

#include <string>

class vtkPointSet;

namespace smg
{

/**
 * The conditions that a mesh brings along: the field array `MeshConditions` of strings, each a part
 * of a problem in the words of a problem file (see IO/Problem/ProblemFile.h).
 */
inline constexpr const char* MeshConditionsName = "MeshConditions";

/** A name that no array of the mesh has, for the point array of one more condition, which is not 0
 * where that holds. */
std::string newMaskName(vtkPointSet& mesh);

/** Adds a condition behind those that the mesh has. */
void addCondition(vtkPointSet& mesh, const std::string& text);

/** Takes all conditions away, with the arrays that are their masks. */
void removeConditions(vtkPointSet& mesh);

/** How many conditions the mesh has. */
int countConditions(vtkPointSet& mesh);

/** Adds what the conditions of a mesh say to a problem. Throws Error if one is no part of one. */
void applyConditions(vtkPointSet& mesh, ProblemDescription& problem);

} // namespace smg
