// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Preview/CoarserSurface.h"

#include "IO/Simplification/Bodies.h"
#include "IO/Simplification/EdgeCollapse.h"
#include "IO/Simplification/VertexClustering.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace smg
{
namespace
{

/** Of the vertices that are left in the surface: whether they are locked. */
std::vector<std::uint8_t> lockedOf(const SurfacePart& surface, std::span<const std::uint8_t> locked)
{
  std::vector<std::uint8_t> left(surface.vertices());
  std::ranges::transform(surface.ids, left.begin(),
    [&locked](std::int64_t id) { return locked[static_cast<std::size_t>(id)]; });
  return left;
}

} // namespace

CoarserSurface coarserSurface(std::span<const double> points, std::span<const std::int64_t> corners,
  std::span<const std::uint8_t> locked, std::int64_t most)
{
  SurfacePart surface;
  surface.points.assign(points.begin(), points.end());
  surface.ids.resize(points.size() / 3);
  std::iota(surface.ids.begin(), surface.ids.end(), 0);
  std::ranges::transform(corners, std::back_inserter(surface.corners),
    [](std::int64_t corner) { return static_cast<std::uint32_t>(corner); });
  surface.dropUnusedVertices();

  const auto wanted = static_cast<std::size_t>(
    most + std::ranges::count_if(locked, [](std::uint8_t is) { return is != 0; }));
  const KeptBodies bodies = keepLargestBodies(surface, lockedOf(surface, locked), bodiesFor(most));
  if (!bodies.areFragments && surface.vertices() > wanted)
  {
    collapseEdges(surface, lockedOf(surface, locked), { .vertices = wanted, .mayPinch = true });
  }
  if (surface.vertices() > wanted + wanted / 4)
  {
    clusterVertices(surface, wanted); // its edges cannot be collapsed
  }
  CoarserSurface coarser;
  std::vector<std::uint32_t> order(surface.vertices());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t v) { return surface.ids[v]; });
  std::vector<std::int64_t> places(order.size());
  for (const std::uint32_t v : order)
  {
    places[v] = static_cast<std::int64_t>(coarser.vertices.size());
    coarser.vertices.push_back(surface.ids[v]);
  }
  std::ranges::transform(surface.corners, std::back_inserter(coarser.corners),
    [&places](std::uint32_t corner) { return places[corner]; });
  return coarser;
}

} // namespace smg
