// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

namespace smg
{

/** Makes the points of a mesh that are in groups its column VertexGroups, out of core: sorted by
 * vertex, in one pass over them. */
void addVertexGroups(RawMesh& mesh, Workspace& workspace);

} // namespace smg
