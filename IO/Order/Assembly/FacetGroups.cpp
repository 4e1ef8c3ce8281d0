// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/FacetGroups.h"

#include "IO/External/ExternalSort.h"
#include "IO/External/Relabelling.h"
#include "IO/Import/GroupTable.h"
#include "IO/Import/VertexFilter.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <span>

// The facets of a file meet those of its cells out of core: both are sorted by their corners in
// ascending order, and merged. Of a volume with n cells and m facets in groups there are 4 n facets
// of cells; only those whose corners all belong to some facet in a group are sorted, which a bit a
// vertex tells. On the boundary of a body these are hardly more than m.
//
// Where memory is too small for a bit a vertex, several vertices share one: then more facets are
// sorted, with the same result.
//
// Cost: one pass over the corners of the cells, and sorts of the facets in groups and of the facets
// of cells that are candidates. Of equal facets of cells the first in the stream counts, so that
// each facet in a group has one cell; equal facets of the file are in the groups of all of them.

namespace smg
{
namespace
{

using FacetCorners = std::array<std::uint32_t, 3>; ///< ascending; of an edge the third is NoIndex

FacetCorners cornersOfFacet(std::span<const std::uint32_t> corners)
{
  FacetCorners sorted{ corners[0], corners[1], corners.size() > 2 ? corners[2] : NoIndex };
  std::ranges::sort(sorted);
  return sorted;
}

/** A facet of the file. */
struct FiledFacet
{
  FacetCorners corners;
  std::uint32_t set;
  auto operator<=>(const FiledFacet&) const = default;
};

/** A facet of a cell. */
struct FacetOfCell
{
  FacetCorners corners;
  std::uint32_t cell;
  std::uint32_t facet;
  auto operator<=>(const FacetOfCell&) const = default;
};

/** The facets of the file by the stream indices of their corners, unsorted; returns the number of
 * those with a vertex of no cell. */
std::int64_t readFacets(const RawMesh& mesh, const StreamLayout& layout, Workspace& workspace,
  VertexFilter& filter, ExternalSort<FiledFacet>& facets)
{
  Relabelling places(workspace, mesh.vertices, workspace.available() / 2);
  OrderedVertexReader vertices(layout.vertices, mesh.doublePositions);
  OrderedVertex<double> vertex;
  for (std::uint32_t place = 0; vertices.next(vertex); ++place)
  {
    places.put(vertex.id, place);
  }
  RecordFile<GroupSet>::Reader sets(mesh.facets.sets);
  std::int64_t elsewhere = 0;
  places.apply(mesh.facets.corners, static_cast<std::size_t>(cornersOf(mesh.cellType) - 1),
    [&](std::span<const std::uint32_t> corners)
    {
      GroupSet set = 0;
      sets.next(set);
      if (std::ranges::find(corners, NoIndex) != corners.end())
      {
        ++elsewhere;
        return;
      }
      for (const std::uint32_t corner : corners)
      {
        filter.add(corner);
      }
      facets.put({ cornersOfFacet(corners), set });
    });
  return elsewhere;
}

/** The facets of cells that may be in groups. */
void readCandidates(const RawMesh& mesh, const StreamLayout& layout, const VertexFilter& filter,
  ExternalSort<FacetOfCell>& candidates)
{
  const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
  RecordFile<std::uint32_t>::Reader cells(layout.corners);
  std::array<std::uint32_t, 4> buffer{};
  const std::span<std::uint32_t> corners = std::span(buffer).first(count);
  const unsigned all = (1U << count) - 1U;
  for (std::uint32_t cell = 0; cells.next(corners); ++cell)
  {
    unsigned known = 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      known |= static_cast<unsigned>(filter.has(corners[k])) << k;
    }
    for (std::uint32_t facet = 0; facet < count; ++facet)
    {
      if ((known | 1U << facet) == all)
      {
        std::array<std::uint32_t, 3> others{};
        for (std::size_t k = 0, other = 0; k < count; ++k)
        {
          if (k != facet)
          {
            others[other++] = corners[k];
          }
        }
        candidates.put({ cornersOfFacet(std::span(others).first(count - 1)), cell, facet });
      }
    }
  }
}

} // namespace

void findFacetGroups(const RawMesh& mesh, StreamLayout& layout, Workspace& workspace)
{
  layout.groups = mesh.groups;
  if (mesh.facets.sets.size() == 0)
  {
    return;
  }
  GroupSets sets(mesh.groups.sets);
  const std::int64_t memory = workspace.available() / 4;
  ExternalSort<FacetOfCell> candidates(workspace, memory);
  ExternalSort<FiledFacet> facets(workspace, memory);
  {
    VertexFilter filter(workspace, layout.vertexCount);
    layout.facetsElsewhere = readFacets(mesh, layout, workspace, filter, facets);
    readCandidates(mesh, layout, filter, candidates);
  }
  facets.sort();
  candidates.sort();
  ExternalSort<GroupedFacet> found(workspace, memory / 2);
  FiledFacet facet{};
  FacetOfCell candidate{};
  bool hasCandidate = candidates.next(candidate);
  for (bool has = facets.next(facet); has;)
  {
    const FacetCorners corners = facet.corners;
    GroupSet set = 0;
    std::int64_t equal = 0;
    for (; has && facet.corners == corners; has = facets.next(facet), ++equal)
    {
      set = sets.join(set, static_cast<GroupSet>(facet.set));
    }
    while (hasCandidate && candidate.corners < corners)
    {
      hasCandidate = candidates.next(candidate);
    }
    if (hasCandidate && candidate.corners == corners)
    {
      found.put({ candidate.cell, static_cast<std::uint16_t>(candidate.facet), set });
    }
    else
    {
      layout.facetsElsewhere += equal;
    }
  }
  found.sort();
  for (GroupedFacet grouped{}; found.next(grouped);)
  {
    layout.facetGroups.put(grouped);
  }
  layout.facetGroups.close();
  layout.groups.sets = sets.all();
}

} // namespace smg
