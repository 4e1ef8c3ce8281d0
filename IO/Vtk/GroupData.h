// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Groups.h"

#include "vtkStreamingMultigridIOModule.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace smg
{

/** Field array of a mesh: its groups as JSON (IO/Mesh/GroupsJson.h), which give the arrays
 * VertexGroups, FacetGroups and CellGroups a meaning. Views do not list it. */
inline constexpr const char* MeshGroupsName = "MeshGroups";

/** Adds the groups to the field data, if there are any. */
void addGroups(vtkDataObject& mesh, const MeshGroups& groups);

/** The groups of the field data; none if there are none. Throws Error if they cannot be read. */
VTKSTREAMINGMULTIGRIDIO_EXPORT MeshGroups groupsIn(vtkDataObject& mesh);

} // namespace smg
