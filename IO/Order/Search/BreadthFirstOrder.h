// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/PageBuilder.h"

namespace smg
{

/** Options of the planning of a breadth-first order. */
struct BreadthFirstOptions
{
  /** The number of landmarks, from which distances are measured; 0: each component starts at its
   * end. Each landmark costs a search, so large meshes, which profit less, use fewer, but at least
   * four. */
  int landmarks = 16;
  /** Components with fewer vertices start at their ends. */
  std::int64_t minPlanned = 4096;
};

/** How often pages were loaded, for users and tests. */
struct PageTraffic
{
  std::int64_t pages = 0;
  std::int64_t loads = 0;      ///< while computing the order
  std::int64_t probeLoads = 0; ///< while planning it
  std::int64_t probes = 0;
};

/**
 * Sorts paged vertices in a breadth-first order with a small span and width, component by
 * component: a multi-source search whose sources and start levels are chosen by the distances from
 * a few landmarks. Sets `components` in the counts. The search uses up the places of the pages, so
 * a mesh can be ordered once.
 *
 * Uses the memory that the workspace has available: at least about 2 MiB, a bit per vertex, and a
 * few of the largest pages. Throws Error.
 */
OrderedVertices breadthFirstOrder(PagedMesh& mesh, Workspace& workspace,
  const BreadthFirstOptions& options = {}, PageTraffic* traffic = nullptr);

/** The number of components, for orders that do not search. It neither reads nor changes places. */
std::int64_t countComponents(PagedMesh& mesh, Workspace& workspace);

} // namespace smg
