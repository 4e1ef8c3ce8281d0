// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Mesh/Columns.h"
#include "smg/Groups.h"

#include "vtkStreamingMultigridIOModule.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace smg
{

/** Adds the groups to the field data, if there are any. */
void addGroups(vtkDataObject& mesh, const MeshGroups& groups);

/** The groups of the field data; none if there are none. Throws Error if they cannot be read. */
VTKSTREAMINGMULTIGRIDIO_EXPORT MeshGroups groupsIn(vtkDataObject& mesh);

} // namespace smg
