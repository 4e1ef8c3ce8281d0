// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Results/CellNormals.h"
#include "smg/Export.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Adds the normal of a triangle, weighted with its angle at corner `k`, to the sum there. */
inline void addNormal(const TriangleShape& shape, std::size_t k, std::span<double, 3> sum)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sum[axis] += shape.angles[k] * shape.normal[axis];
  }
}

/** The unit vector along a sum; zero if that is zero. */
SMG_EXPORT std::array<float, 3> unitNormal(std::span<const double, 3> sum);

/** Triangles of a mesh in memory. */
struct TriangleView
{
  std::span<const double> positions;     ///< x, y, z of each vertex
  std::span<const std::int64_t> corners; ///< three a triangle
  std::span<const std::uint8_t> flags;   ///< see CellFlag; empty: none
};

/** The sums of normals at the vertices of a part of a mesh, 3 numbers each, as VertexNormals has
 * them: those of all parts together have the directions of the normals. */
SMG_EXPORT std::vector<double> normalSums(const TriangleView& triangles);

/** The unit normals of such sums, 3 numbers a vertex. */
SMG_EXPORT std::vector<float> unitNormals(std::span<const double> sums);

/** The unit normals of the triangles, 3 numbers each, as CellNormals has them. */
SMG_EXPORT std::vector<float> normalsOf(const TriangleView& triangles);

} // namespace smg
