// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedElements.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

// Cells, edges and facets between parts. Items with the same vertices meet at the owner of their
// first vertex (rendezvous()), which is the only process that has to know all of them. Each process
// sends only items whose vertices are all shared: their number grows with the interfaces, not with
// the parts.

namespace smg
{
namespace
{

/** A cell of a part, in which several processes are compared by the vertices. */
struct PartCell
{
  /// Stream indices, ascending; of a triangle the last one is the largest number.
  std::array<std::int64_t, 4> key;
};

} // namespace

std::int64_t repeatedCells(const SharedVertices& vertices, const MeshPart& part)
{
  const std::vector<std::int64_t>& corners = part.block.corners;
  const auto each = static_cast<std::size_t>(cornersOf(part.info.cellType));
  std::vector<PartCell> items;
  for (std::size_t c = 0; c < corners.size(); c += each)
  {
    const auto cell = std::span(corners).subspan(c, each);
    // Another process can only have the cell if it has all of its corners.
    if (!std::ranges::all_of(cell, [&](std::int64_t v) { return vertices.isShared(v); }))
    {
      continue;
    }
    PartCell item{};
    item.key.fill(std::numeric_limits<std::int64_t>::max());
    std::ranges::transform(cell, item.key.begin(), [&](std::int64_t v) { return vertices.id(v); });
    // In ascending order: the same vertices are the same cell, however it is turned.
    std::ranges::sort(item.key);
    items.push_back(item);
  }
  std::int64_t repeated = 0;
  rendezvous<std::uint8_t>(vertices, items,
    [&](auto meetings)
    {
      // A cell that one process has twice is left to the checks of the mesh itself.
      const auto isElsewhere = [&](const auto& meeting)
      { return meeting.process != meetings.front().process; };
      repeated += std::ranges::any_of(meetings, isElsewhere) ? 1 : 0;
    });
  vertices.team().sum({ &repeated, 1 });
  return repeated;
}

namespace
{

/** An edge of cells of a part. */
struct PartEdge
{
  std::array<std::int64_t, 2> key; ///< stream indices
  EdgeStiffness::Sum sum;
};

} // namespace

void joinSharedEdges(const SharedVertices& vertices, EdgeStiffness& edges)
{
  // Visits the shared edges in the same order when they are sent and when the answers come.
  const auto forShared = [&](auto visit)
  {
    for (std::int64_t low = 0; low < vertices.vertices(); ++low)
    {
      if (vertices.isShared(low))
      {
        edges.visit(low,
          [&](std::int64_t high, EdgeStiffness::Sum& sum)
          {
            if (vertices.isShared(high))
            {
              visit(low, high, sum);
            }
          });
      }
    }
  };
  std::vector<PartEdge> items;
  forShared(
    [&](std::int64_t low, std::int64_t high, const EdgeStiffness::Sum& sum) {
      items.push_back({ { vertices.id(low), vertices.id(high) }, sum });
    });
  const auto sums = rendezvous<EdgeStiffness::Sum>(vertices, items,
    [&edges](auto meetings)
    {
      // The first process keeps the edge with the sum over all parts. The weights are joined before
      // they become entries, since clamped and uniform weights are not sums over the parts.
      EdgeStiffness::Sum& whole = meetings.front().answer;
      whole = meetings.front().item.sum;
      for (auto& meeting : meetings.subspan(1))
      {
        edges.join(whole, meeting.item.sum);
        meeting.answer = { EdgeStiffness::Elsewhere, 0.0 };
      }
    });
  // One answer for each edge sent, in the same order.
  auto next = sums.begin();
  forShared([&next](std::int64_t, std::int64_t, EdgeStiffness::Sum& sum) { sum = *next++; });
}

namespace
{

/** A facet of a cell of a part. */
struct PartFacet
{
  FacetSet::Corners key; ///< stream indices
  bool several;          ///< cells
};

} // namespace

FacetSet innerFacets(const SharedVertices& vertices, CellType type, const OpenFacets& facets)
{
  const bool isEdge = type == CellType::Triangle;
  std::vector<PartFacet> items;
  std::vector<FacetSet::Corners> places; // vertices of the part
  for (std::int64_t low = 0; low < vertices.vertices(); ++low)
  {
    // Another process can only have the facet if it has all corners.
    // Facets are listed by their lowest vertex.
    if (!vertices.isShared(low))
    {
      continue;
    }
    facets.visit(low,
      [&](std::int64_t middle, std::int64_t high, bool several)
      {
        if (vertices.isShared(middle) && (isEdge || vertices.isShared(high)))
        {
          places.push_back({ low, middle, isEdge ? 0 : high });
          items.push_back(
            { { vertices.id(low), vertices.id(middle), isEdge ? 0 : vertices.id(high) }, several });
        }
      });
  }
  const auto inner = rendezvous<std::uint8_t>(vertices, items,
    [](auto meetings)
    {
      for (auto& meeting : meetings)
      {
        // Several parts have it, so it is not a boundary facet of the mesh.
        meeting.answer = meetings.size() > 1 ? 1 : 0;
      }
    });
  std::vector<FacetSet::Corners> found;
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    // A facet with several cells in this part counts as inner anyway.
    if (inner[k] != 0 && !items[k].several)
    {
      found.push_back(places[k]);
    }
  }
  return FacetSet(std::move(found));
}

} // namespace smg
