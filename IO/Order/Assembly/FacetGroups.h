// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Assembly/StreamAssembly.h"

namespace smg
{

/** Finds the facets of the mesh that are in groups among those of its cells in stream order, and
 * sets the groups and facets of the layout. A facet that no cell has is counted. */
void findFacetGroups(const RawMesh& mesh, StreamLayout& layout, Workspace& workspace);

} // namespace smg
