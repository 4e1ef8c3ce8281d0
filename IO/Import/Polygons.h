// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

namespace smg
{

/**
 * Cuts the polygons of a mesh anew that their fans do not cover, such as concave ones, and notes
 * those that cannot be cut: their sides cross, or they have more corners than fit into the memory.
 * A mesh without polygons costs nothing. Throws Error; Cancelled.
 */
void cutPolygons(RawMesh& mesh, Workspace& workspace);

} // namespace smg
