// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "smg/Groups.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/** The members of the groups of a mesh, for writers of formats with places for them: of each chunk
 * of vertices or elements, by its columns. */
class WrittenGroups
{
public:
  /** The columns of groups count as placed. */
  WrittenGroups(const MeshFileInfo& info, PlacedColumns& columns)
    : Groups(info.groupTable)
    , OfVertices(columns.ofVertices(VertexGroupsName, 1, 1))
    , OfFacets(
        columns.ofElements(FacetGroupsName, cornersOf(info.cellType), cornersOf(info.cellType)))
    , OfCells(columns.ofElements(CellGroupsName, 1, 1))
  {
  }

  const std::vector<Group>& groups() const { return this->Groups.groups; }
  bool hasFacets() const { return this->OfFacets >= 0; }
  bool hasCells() const { return this->OfCells >= 0; }

  /** Passes each vertex of the chunk that is in groups, and the indices of these. */
  template <class Take>
  void forEachVertex(const VertexChunk& chunk, Take&& take) const
  {
    this->forEachOf(chunk.columns, this->OfVertices,
      [&](std::size_t vertex, std::size_t, std::span<const std::uint32_t> set)
      { take(vertex, set); });
  }
  /** The same of the elements, polygons or tetrahedra. */
  template <class Take>
  void forEachCell(const ElementChunk& chunk, Take&& take) const
  {
    this->forEachOf(chunk.columns, this->OfCells,
      [&](std::size_t element, std::size_t, std::span<const std::uint32_t> set)
      { take(element, set); });
  }
  /** Passes each facet of the chunk that is in groups: the element, the corner opposite to it, its
   * corners, so that it faces outwards, and the groups. Only triangles and tetrahedra have such
   * facets. */
  template <class Take>
  void forEachFacet(const ElementChunk& chunk, Take&& take) const
  {
    std::size_t begin = 0, element = 0;
    this->forEachOf(chunk.columns, this->OfFacets,
      [&](std::size_t at, std::size_t opposite, std::span<const std::uint32_t> set)
      {
        for (; element < at; ++element)
        {
          begin += chunk.sizes[element];
        }
        const std::size_t size = chunk.sizes[at];
        if (size != this->components(chunk.columns))
        {
          return;
        }
        std::array<std::int64_t, 3> corners{};
        for (std::size_t k = 0, other = 0; k < size; ++k)
        {
          if (k != opposite)
          {
            corners[other++] = chunk.corners[begin + k];
          }
        }
        if (opposite % 2 != 0)
        {
          std::swap(corners[size - 3], corners[size - 2]); // to face outwards
        }
        take(at, opposite, std::span<const std::int64_t>(corners).first(size - 1), set);
      });
  }

private:
  std::size_t components(const std::vector<Column>& columns) const
  {
    return static_cast<std::size_t>(
      columns[static_cast<std::size_t>(this->OfFacets)].spec.components);
  }

  template <class Take>
  void forEachOf(const std::vector<Column>& columns, std::ptrdiff_t place, Take&& take) const
  {
    if (place < 0)
    {
      return;
    }
    const Column& column = columns[static_cast<std::size_t>(place)];
    const auto components = static_cast<std::size_t>(column.spec.components);
    const std::span<const GroupSet> sets = column.as<GroupSet>();
    for (std::size_t i = 0; i < sets.size(); ++i)
    {
      if (sets[i] > 0 && sets[i] < this->Groups.sets.size())
      {
        take(i / components, i % components,
          std::span<const std::uint32_t>(this->Groups.sets[sets[i]]));
      }
    }
  }

  MeshGroups Groups;
  std::ptrdiff_t OfVertices, OfFacets, OfCells; ///< columns; -1: there is none
};

} // namespace smg
