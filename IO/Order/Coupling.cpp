// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Coupling.h"

#include "Solver/Problem/FacetCopies.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

// A row waits for the vertices that are coupled to it, and all later rows with it (VertexTies). In
// an order that does not know of couplings the other side of a periodic body comes last, so that a
// solve would have the whole mesh in memory; in one that treats coupled vertices as neighbours the
// window is about twice that of the body alone.
//
// The facets of the sides are those of the file, and their number is that of a section through the
// mesh: they are held in memory. Cost: one pass over the facets in groups for each side, and one
// over the positions.

namespace smg
{
namespace
{

/** The column of the groups of facets, of a mesh that was a stream; null: it has none. */
const RawColumn* facetColumn(const RawMesh& mesh)
{
  const auto found = std::ranges::find(
    mesh.elementColumns, FacetGroupsName, [](const RawColumn& column) { return column.spec.name; });
  return found == mesh.elementColumns.end() ? nullptr : &*found;
}

/** The facets of the groups of these names, by the vertices of the file, without positions. */
std::vector<std::array<std::uint32_t, 3>> facetsIn(
  const RawMesh& mesh, const std::vector<std::string>& names)
{
  std::vector<std::uint32_t> groups;
  for (const std::string& name : names)
  {
    const std::vector<std::uint32_t> found = mesh.groups.find(name, GroupOf::Facets);
    groups.insert(groups.end(), found.begin(), found.end());
  }
  const std::vector<std::uint8_t> wanted = mesh.groups.setsWith(groups);
  const auto isWanted = [&](GroupSet set) { return set < wanted.size() && wanted[set] != 0; };
  std::vector<std::array<std::uint32_t, 3>> facets;
  if (const RawColumn* column = facetColumn(mesh))
  {
    const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
    std::array<std::uint32_t, 4> cell{};
    std::array<GroupSet, 4> ofCell{};
    RecordFile<std::uint32_t>::Reader cells(mesh.corners);
    BucketFile::Reader tuples(column->tuples);
    while (cells.next(std::span(cell).first(count)))
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        tuples.get(ofCell[k]);
      }
      for (std::size_t k = 0; k < count; ++k)
      {
        std::array<std::uint32_t, 3> facet{};
        std::copy_if(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(count), facet.begin(),
          [opposite = cell[k]](std::uint32_t vertex) { return vertex != opposite; });
        if (isWanted(ofCell[k]))
        {
          facets.push_back(facet);
        }
      }
    }
    return facets;
  }
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType) - 1);
  RecordFile<std::uint32_t>::Reader numbers(mesh.facets.corners);
  RecordFile<GroupSet>::Reader sets(mesh.facets.sets);
  std::array<std::uint32_t, 3> facet{};
  for (GroupSet set = 0; numbers.next(std::span(facet).first(corners)) && sets.next(set);)
  {
    if (isWanted(set))
    {
      facets.push_back(facet);
    }
  }
  return facets;
}

/** Adds the facets with the positions of their corners. */
template <class Real>
void addPlaced(
  const RawMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& facets, FacetList& to)
{
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType) - 1);
  std::vector<std::uint32_t> vertices;
  for (const auto& facet : facets)
  {
    vertices.insert(
      vertices.end(), facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(corners));
  }
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  vertices.erase(repeated.begin(), repeated.end());
  std::vector<std::array<double, 3>> points;
  points.reserve(vertices.size());
  BucketFile::Reader positions(mesh.positions);
  std::array<Real, 3> position{};
  for (std::uint32_t vertex = 0; points.size() < vertices.size() && positions.get(position);
       ++vertex)
  {
    if (vertices[points.size()] == vertex)
    {
      points.push_back({ position[0], position[1], position[2] });
    }
  }
  for (const auto& facet : facets)
  {
    std::int64_t numbers[3] = {};
    const double* places[3] = {};
    for (std::size_t k = 0; k < corners; ++k)
    {
      numbers[k] = facet[k];
      places[k] = points[static_cast<std::size_t>(
                           std::ranges::lower_bound(vertices, facet[k]) - vertices.begin())]
                    .data();
    }
    to.add(numbers, places);
  }
  to.finish();
}

void fill(const RawMesh& mesh, const std::vector<std::string>& names, FacetList& list)
{
  mesh.doublePositions ? addPlaced<double>(mesh, facetsIn(mesh, names), list)
                       : addPlaced<float>(mesh, facetsIn(mesh, names), list);
}

} // namespace

CoupledGroups coupledGroups(const ProblemDescription& problem)
{
  const auto namesOf = [](const Where& where)
  {
    const auto* group = std::get_if<InGroup>(&where);
    return group ? group->names : std::vector<std::string>();
  };
  CoupledGroups coupled;
  for (const ProblemDescription::Periodic& sides : problem.periodic)
  {
    coupled.periodic.emplace_back(namesOf(sides.from), namesOf(sides.to));
  }
  for (const ProblemDescription::Interface& contact : problem.interfaces)
  {
    coupled.interfaces.push_back(namesOf(contact.where));
  }
  return coupled;
}

void linkCoupled(RawMesh& mesh, const CoupledGroups& coupled, Workspace& workspace)
{
  if (mesh.facets.sets.size() == 0 && !facetColumn(mesh))
  {
    return;
  }
  const int corners = cornersOf(mesh.cellType) - 1;
  const auto link = [&](const FacetList& first, const FacetCopies& copies)
  {
    for (const FacetCopy& copy : copies.pairs)
    {
      for (int k = 0; k < corners; ++k)
      {
        const auto corner = static_cast<std::size_t>(k);
        mesh.links.put(static_cast<std::uint32_t>(first.facets()[copy.first][corner]));
        mesh.links.put(static_cast<std::uint32_t>(copy.corners[corner]));
      }
    }
  };
  for (const auto& [from, to] : coupled.periodic)
  {
    FacetList first(workspace.pool(), corners), second(workspace.pool(), corners);
    fill(mesh, from, first);
    fill(mesh, to, second);
    link(
      first, findCopies(first, second, shiftBetween(first, second), usualTolerance(first, second)));
  }
  for (const std::vector<std::string>& names : coupled.interfaces)
  {
    FacetList facets(workspace.pool(), corners);
    fill(mesh, names, facets);
    link(facets, findCopies(facets, facets, {}, usualTolerance(facets, facets)));
  }
  mesh.links.close();
}

} // namespace smg
