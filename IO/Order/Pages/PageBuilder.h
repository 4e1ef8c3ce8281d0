// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "IO/Order/Pages/VertexPages.h"
#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/** Options for making pages. */
struct PageOptions
{
  /** Vertices of a page; 0: chosen from the mesh and the memory. */
  int pageVertices = 0;
  /** For tests: the topological order, regardless of the coordinates. */
  bool topological = false;
};

/** The pages of a mesh, without its isolated vertices, and its counts. */
struct PagedMesh
{
  VertexPages pages;
  MeshCounts counts; ///< without components
  /** Coordinates of the vertices whose rank is a multiple of sampleStride, x, y, z each. */
  std::vector<float> samples;
  std::int64_t sampleStride = 1;
  /** The share of the directed edges that lead to another page. */
  double crossing = 0;
};

/**
 * Puts the vertices of a mesh into pages along a Hilbert curve, out of core: keys by a metric that
 * makes edges about equally long, an external sort, the cells renumbered, and the cells of a group
 * of pages collected at a time. Where coordinates tell nothing about neighbourhood, repeated
 * contraction of the graph of the mesh takes the place of the curve.
 *
 * Throws Error; Cancelled.
 */
PagedMesh buildPages(const RawMesh& mesh, Workspace& workspace, const PageOptions& options = {});

/** The number of vertices of a page, a power of two, with which a breadth-first search loads
 * each page about once: the pages at its front fit into the memory, and the list of all pages
 * is small. */
int choosePageVertices(
  CellType cellType, bool doublePositions, std::int64_t vertices, std::int64_t memory);

/** The share of directed edges that may leave their page: an order with more is bad. It is two to
 * three times that of meshes with useful coordinates. */
double maxCrossing(CellType cellType, int pageVertices);

} // namespace smg
