// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Simplification/VertexClustering.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

// Merging of vertices by their positions, by meshoptimizer (meshopt_simplifySloppy): for surfaces
// whose edges cannot be collapsed far enough. The target of the library is a number of triangles,
// so fewer are asked for until few enough vertices are left.

namespace smg
{
namespace
{

/** The points scaled into the unit cube at the origin, where single precision is enough. */
std::vector<float> unitPoints(const std::vector<double>& points)
{
  std::array<double, 3> low{}, high{};
  double extent = 0.0;
  for (std::size_t axis = 0; axis < 3 && !points.empty(); ++axis)
  {
    low[axis] = high[axis] = points[axis];
    for (std::size_t i = axis; i < points.size(); i += 3)
    {
      low[axis] = std::min(low[axis], points[i]);
      high[axis] = std::max(high[axis], points[i]);
    }
    extent = std::max(extent, high[axis] - low[axis]);
  }
  std::vector<float> unit(points.size());
  for (std::size_t i = 0; i < points.size() && extent > 0.0; ++i)
  {
    unit[i] = static_cast<float>((points[i] - low[i % 3]) / extent);
  }
  return unit;
}

/** Keeps the first of the triangles with the same corners. */
void dropRepeated(std::vector<std::uint32_t>& corners)
{
  std::set<std::array<std::uint32_t, 3>> known;
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
  {
    std::array<std::uint32_t, 3> triangle{ corners[i], corners[i + 1], corners[i + 2] };
    std::ranges::sort(triangle);
    if (known.insert(triangle).second)
    {
      kept.insert(kept.end(), { corners[i], corners[i + 1], corners[i + 2] });
    }
  }
  corners = std::move(kept);
}

} // namespace

void clusterVertices(SurfacePart& part, std::size_t vertices)
{
  const std::vector<float> points = unitPoints(part.points);
  // A closed surface has two triangles for each vertex, others have fewer.
  for (std::size_t triangles = 2 * vertices; part.vertices() > vertices && triangles > 0;
       triangles = triangles * 3 / 4)
  {
    std::vector<unsigned> left(part.corners.size());
    const std::size_t target = std::min(part.corners.size(), 3 * triangles);
    left.resize(meshopt_simplifySloppy(left.data(), part.corners.data(), part.corners.size(),
      points.data(), part.vertices(), 3 * sizeof(float), target, 1.0F));
    std::vector<unsigned> used(left);
    std::ranges::sort(used);
    const auto rest = std::ranges::unique(used);
    if (static_cast<std::size_t>(rest.begin() - used.begin()) <= vertices)
    {
      part.corners = std::move(left);
      dropRepeated(part.corners);
      part.dropUnusedVertices();
      return;
    }
  }
}

} // namespace smg
