// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/OrderedVertices.h"
#include "IO/Order/PageBuilder.h"

namespace smg
{

/** How a breadth-first order is planned. */
struct BreadthFirstOptions
{
  /**
   * Vertices that distances are measured from; 0: each component is begun at its end. Each costs a
   * search, so large meshes, which gain less, take fewer, but at least four.
   */
  int landmarks = 16;
  /** Components of fewer vertices are begun at their ends. */
  std::int64_t leastPlanned = 4096;
};

/** How often pages were loaded, for a user and for tests. */
struct PageTraffic
{
  std::int64_t pages = 0;
  std::int64_t loads = 0;      ///< while the order was made
  std::int64_t probeLoads = 0; ///< while it was planned
  std::int64_t probes = 0;
};

/**
 * Brings paged vertices into a breadth-first order with a small span and width, component after
 * component: a multi-source search whose sources and start levels are chosen by the distances from
 * a few landmarks. Sets `components` in the counts. The pages give their places away: a mesh is
 * ordered once.
 *
 * Takes what memory the workspace has available, at least about 2 MiB, a bit a vertex, and a few
 * of the largest pages. Throws Error.
 */
OrderedVertices breadthFirstOrder(PagedMesh& mesh, Workspace& workspace,
  const BreadthFirstOptions& options = {}, PageTraffic* traffic = nullptr);

/** Number of components, for orders that do not search. Places are neither read nor given. */
std::int64_t countComponents(PagedMesh& mesh, Workspace& workspace);

} // namespace smg
