// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/SharedFacets.h"

#include "Solver/Distributed/Rendezvous.h"

#include <utility>

namespace smg
{
namespace
{

/** A facet of cells of a part. */
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
        meeting.answer = meetings.size() > 1 ? 1 : 0;
      }
    });
  std::vector<FacetSet::Corners> found;
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    if (inner[k] != 0 && !items[k].several)
    {
      found.push_back(places[k]);
    }
  }
  return FacetSet(std::move(found));
}

} // namespace smg
