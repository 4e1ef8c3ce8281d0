// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Order/PageBuilder.h"

namespace smg
{

/**
 * The vertices along the Fiedler vector of the mesh's graph, component after component: the order
 * with the smallest width. The vector is that of the graph of the pages, brought to the vertices.
 */
OrderedVertices spectralOrder(PagedMesh& mesh, Workspace& workspace);

} // namespace smg
