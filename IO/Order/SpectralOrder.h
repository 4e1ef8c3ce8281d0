// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Order/PageBuilder.h"

#include <string>
#include <vector>

namespace smg
{

/**
 * The vertices along the Fiedler vector of the mesh's graph, component after component: the order
 * with the smallest width. The vector is that of the graph of the pages, brought to the vertices.
 * Where pages have so little to do with neighbourhood that this graph has no room in the memory, it
 * is the order along the longest axis (AxisOrder.h), and `notes`, if given, says so. Throws Error,
 * Cancelled.
 */
OrderedVertices spectralOrder(
  PagedMesh& mesh, Workspace& workspace, std::vector<std::string>* notes = nullptr);

} // namespace smg
