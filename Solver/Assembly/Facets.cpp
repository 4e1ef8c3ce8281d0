// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Facets.h"

#include "Solver/Mesh/VisitCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstddef>
#include <utility>

// Finds the facets of exactly one cell, the boundary, in one pass over a mesh stream.
//
// Each open vertex has a linked list of the facets whose lowest corner it is, of 16 bytes each. A
// cell looks its facets up there: usually a handful. From MaxWalked facets on, as at the tip of a
// fan, the vertex gets a hash table, without which the time would be quadratic in its number of
// cells. Lists keep the order in which facets were first added, with or without a table, so that
// what is found has the order of the stream for any size of blocks.

namespace smg
{

namespace
{

/** The number of facets of a vertex that are compared one after the other before a table is used.
 */
constexpr int MaxWalked = 64;

} // namespace

void OpenFacets::extend(std::int64_t vertices)
{
  if (vertices - this->Heads.first() > INT32_MAX)
  {
    // Facets store the low 32 bits of their corners, relative to the lowest one.
    throw Error("too many vertices are open at once: convert the mesh with the order bfs");
  }
  this->Heads.extend(vertices);
}

std::int32_t OpenFacets::add(
  std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data)
{
  const Found found = this->findOrAdd(
    low, { static_cast<std::uint32_t>(middle), static_cast<std::uint32_t>(high), 0, data });
  return found.isNew ? Fresh : this->Facets[found.slot].share();
}

std::int32_t OpenFacets::join(
  std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data)
{
  const Found found = this->findOrAdd(
    low, { static_cast<std::uint32_t>(middle), static_cast<std::uint32_t>(high), 0, data });
  return this->Facets[found.slot].data;
}

/** Walks the list of vertex `low`, and appends the facet if it is not there. */
OpenFacets::Found OpenFacets::findOrAdd(std::int64_t low, const Facet& facet)
{
  std::int32_t last = 0;
  int walked = 0;
  for (std::int32_t slot = this->Heads[low]; slot != 0; slot = this->Facets[slot].next)
  {
    if (this->Facets[slot].isSame(facet))
    {
      return { slot, false };
    }
    if (++walked == MaxWalked)
    {
      return this->findInHub(low, facet);
    }
    last = slot;
  }
  const std::int32_t slot = this->Facets.take();
  this->Facets[slot] = facet;
  // Only now: take() may have moved the facets.
  (last == 0 ? this->Heads[low] : this->Facets[last].next) = slot;
  return { slot, true };
}

/** findOrAdd() for a vertex with a long list. The list remains, for take() and visit(). */
OpenFacets::Found OpenFacets::findInHub(std::int64_t low, const Facet& facet)
{
  Hub& hub = this->hubOf(low);
  if (const std::int32_t known = *this->place(hub, facet); known != 0)
  {
    return { known, false };
  }
  const std::int32_t slot = this->Facets.take();
  this->Facets[slot] = facet;
  this->Facets[hub.last].next = slot;
  this->append(hub, slot);
  return { slot, true };
}

/** The table of a vertex, which is made from its list on first use. */
OpenFacets::Hub& OpenFacets::hubOf(std::int64_t low)
{
  const auto [place, isNew] = this->Hubs.try_emplace(low);
  if (isNew)
  {
    for (std::int32_t slot = this->Heads[low]; slot != 0; slot = this->Facets[slot].next)
    {
      this->append(place->second, slot);
    }
  }
  return place->second;
}

/** The entry of the table that has this facet, or the empty one where it belongs: open addressing
 * with linear probing, which ends since at least half of the table is empty. */
std::int32_t* OpenFacets::place(const Hub& hub, const Facet& facet) const
{
  auto* const table = reinterpret_cast<std::int32_t*>(hub.table.data());
  const std::size_t last = hub.table.size() / sizeof(std::int32_t) - 1;
  // The multiplier spreads close numbers (Knuth, The Art of Computer Programming 3, 6.4). Upper
  // bits of the product are taken, since lower ones depend on the lower bits of the key alone.
  const std::uint64_t key = std::uint64_t{ facet.middle } << 32 | facet.high;
  std::size_t k = (key * 0x9e3779b97f4a7c15U) >> 32 & last;
  while (table[k] != 0 && !this->Facets[table[k]].isSame(facet))
  {
    k = (k + 1) & last;
  }
  return table + k;
}

/** Enters the next facet of the list in the table, which is doubled before it is more than half
 * full. */
void OpenFacets::append(Hub& hub, std::int32_t slot)
{
  const std::size_t entries = hub.table.size() / sizeof(std::int32_t);
  if (2 * static_cast<std::size_t>(hub.facets) >= entries)
  {
    const Hub before = std::exchange(hub,
      { Buffer(*this->Memory, std::max<std::size_t>(2 * entries, 4 * MaxWalked) * sizeof(slot)),
        hub.last, hub.facets });
    std::ranges::fill(hub.table.bytes(), std::byte{ 0 });
    const auto* const old = reinterpret_cast<const std::int32_t*>(before.table.data());
    for (std::size_t k = 0; k < entries; ++k)
    {
      if (old[k] != 0)
      {
        *this->place(hub, this->Facets[old[k]]) = old[k];
      }
    }
  }
  *this->place(hub, this->Facets[slot]) = slot;
  hub.last = slot;
  ++hub.facets;
}

/** Adds the facets of the cells of a block; the data of an edge are the direction in which its
 * first triangle runs along it. */
void BoundaryFacets::addCells(const MeshBlock& block)
{
  const auto addCell = [this](const std::int64_t* corners, std::size_t /*c*/)
  {
    for (int k = 0; k < cornersOf(this->Type); ++k)
    {
      const CellFacet facet = facetOf(this->Type, corners, k);
      // Of an edge: 1 if the triangle runs along it from the lower vertex to the higher one,
      // else 2. The corners of edge 1 are 0 and 2, along which the triangle runs from 2 to 0.
      const std::int32_t direction = (facet.order[0] == 0) != (k == 1) ? 1 : 2;
      const std::int32_t other =
        this->Open.add(facet.vertex[0], facet.vertex[1], facet.vertex[2], direction);
      if (this->Type == CellType::Triangle && other == direction)
      {
        this->MaybeTurned.emplace(facet.vertex[0], facet.vertex[1]);
      }
      else if (other == 0 && !this->MaybeTurned.empty())
      {
        // A third triangle: the edge has no two sides that could agree.
        this->MaybeTurned.erase({ facet.vertex[0], facet.vertex[1] });
      }
    }
  };
  forDistinctCells(this->Type, block, addCell);
}

} // namespace smg
