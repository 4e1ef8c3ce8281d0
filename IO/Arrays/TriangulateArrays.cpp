// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/TriangulateArrays.h"

#include "IO/Import/PolygonTriangulation.h"
#include "Solver/Core/Progress.h"

#include <string>
#include <vector>

namespace smg
{

namespace
{

void checkShapes(const ArrayView& points, const ArrayView& corners, const ArrayView& offsets)
{
  if (points.columns != 3 || corners.columns != 1 || offsets.columns != 1)
  {
    throw ArgumentError("points: must have 3 columns; corners and offsets must have one.");
  }
  if (!corners.isInteger() || !offsets.isInteger())
  {
    throw ArgumentError("cells: must be integers, the rows of points.");
  }
}

} // namespace

void triangulateArrays(const ArrayView& points, const ArrayView& corners, const ArrayView& offsets,
  const ProgressFunction& progress, std::int64_t* triangles)
{
  checkShapes(points, corners, offsets);
  Progress reported(progress);
  PolygonTriangulation triangulation;
  std::vector<std::int64_t> polygon;
  std::vector<double> positions;
  constexpr std::int64_t Often = 4096;
  for (std::int64_t k = 0; k + 1 < offsets.rows; ++k)
  {
    const double done = static_cast<double>(k) / static_cast<double>(offsets.rows);
    if (k % Often == 0)
    {
      reported.update(done);
    }
    const auto begin = offsets.value<std::int64_t>(k, 0);
    const auto end = offsets.value<std::int64_t>(k + 1, 0);
    if (begin < 0 || end > corners.rows || end < begin || end - begin < 3)
    {
      throw ArgumentError("cells: the polygon " + std::to_string(k) +
                          " has less than three corners, or some that are not there.");
    }
    polygon.clear();
    positions.clear();
    for (std::int64_t at = begin; at < end; ++at)
    {
      const auto corner = corners.value<std::int64_t>(at, 0);
      if (corner < 0 || corner >= points.rows)
      {
        throw ArgumentError("cells: the polygon " + std::to_string(k) + " has the corner " +
                            std::to_string(corner) + ", but the points are 0 to " +
                            std::to_string(points.rows - 1) + '.');
      }
      polygon.push_back(corner);
      for (std::int64_t axis = 0; axis < 3; ++axis)
      {
        positions.push_back(points.value<double>(corner, axis));
      }
    }
    triangulation.cut(positions, [&] { reported.update(done); });
    for (const PolygonTriangulation::Triangle& triangle : triangulation.triangles())
    {
      for (const std::uint32_t place : triangle)
      {
        *triangles++ = polygon[place];
      }
    }
  }
}

} // namespace smg
