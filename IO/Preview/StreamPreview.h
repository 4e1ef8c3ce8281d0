// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Preview.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/**
 * Reads the mesh stream once and creates a preview: the surface simplified by edge collapse to at
 * most `maximumPoints` points (MinPreviewPoints to MaxPreviewPoints), in stream order; of
 * tetrahedra, their outer surface. Each point is a vertex of the mesh, with the columns of the
 * stream and a normal: the mean of the triangles around it by their angles. A mesh of fewer points
 * is returned unchanged. No vertex is a ghost.
 *
 * Where the edges of a mesh cannot be collapsed, vertices near one another are merged instead.
 *
 * Memory is bounded by that of StreamSimplifier, which is what the number of points and the width
 * of the stream ask for, but at most `maxMemory` bytes. Throws Error and Cancelled.
 */
SMG_EXPORT MeshPiece makePreview(MeshSource& mesh,
  std::int64_t maximumPoints = DefaultPreviewPoints, const ProgressFunction& progress = {},
  std::int64_t maxMemory = std::numeric_limits<std::int64_t>::max());

/** The error message for an empty preview of a mesh that is not empty. */
SMG_EXPORT std::string emptyPreview(std::int64_t maximumPoints);

/** Triangles between some of the vertices of a surface. */
struct CoarserSurface
{
  std::vector<std::int64_t> vertices; ///< their numbers in the surface, ascending
  std::vector<std::int64_t> corners;  ///< places in `vertices`, three a triangle
};

/**
 * Simplifies a surface in memory by edge collapse, as StreamSimplifier does at its end.
 * @param points x, y, z of each vertex
 * @param corners three a triangle
 * @param locked of each vertex: not 0 for one that stays
 * @param most so many vertices are left, besides the locked ones
 */
SMG_EXPORT CoarserSurface coarserSurface(std::span<const double> points,
  std::span<const std::int64_t> corners, std::span<const std::uint8_t> locked, std::int64_t most);

} // namespace smg
