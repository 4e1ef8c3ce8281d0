// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/PageBuilder.h"

#include <string>
#include <vector>

namespace smg
{

/**
 * The vertices along the Fiedler vector of the graph of the mesh, component by component: the order
 * with the smallest width. The vector is computed for a graph of patches of vertices, and
 * interpolated to the vertices. If the pages represent neighbourhood so badly that this graph does
 * not fit into the memory, the order along the longest axis (AxisOrder.h) is taken instead, with a
 * note in `notes`, if given. Throws Error, Cancelled.
 */
OrderedVertices spectralOrder(
  PagedMesh& mesh, Workspace& workspace, std::vector<std::string>* notes = nullptr);

} // namespace smg
