// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Arrays/ArrayView.h"
#include "smg/Error.h"

#include <cstdint>

namespace smg
{

/**
 * Cuts polygons in memory into triangles, as a file with these polygons is read.
 * @param points x, y, z of each
 * @param corners the points of all polygons, one polygon after the other
 * @param offsets where the corners of each polygon begin and, last, where all end
 * @param triangles room for the corners of the triangles of all polygons, in their order: those of
 * a polygon of n corners are n - 2, three numbers of points each
 * @throws ArgumentError if the arrays do not fit, or a polygon has less than three corners;
 * Cancelled
 */
SMG_EXPORT void triangulateArrays(const ArrayView& points, const ArrayView& corners,
  const ArrayView& offsets, const ProgressFunction& progress, std::int64_t* triangles);

} // namespace smg
