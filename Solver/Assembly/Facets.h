// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <set>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace smg
{

/** A facet of exactly one cell, or an inner one that has conditions, with these (see FacetBatch).
 */
struct BoundaryFacet
{
  static constexpr int cornersOf(CellType type) { return smg::cornersOf(type) - 1; }

  std::int64_t corners[3]; ///< stream indices, ascending; two for an edge
  /** Where the corners are: others than these if they are tied to them, see VertexTies. */
  std::int64_t vertices[3] = { corners[0], corners[1], corners[2] };
  std::int32_t flux = -1; ///< index of its condition
  std::int32_t robin = -1;
  bool isInner = false;
  // In the order of the corners; null without a condition.
  const double* fluxValue = nullptr;   ///< `columns` per corner
  const double* coefficient = nullptr; ///< one per corner
  const double* ambient = nullptr;     ///< `columns` per corner
};

/** The length or area of a facet with these corners. */
inline double facetArea(CellType type, const double* const* points)
{
  const Vector ab = difference(points[1], points[0]);
  if (type == CellType::Triangle)
  {
    return std::sqrt(dot(ab, ab));
  }
  const Vector normal = cross(ab, difference(points[2], points[0]));
  return 0.5 * std::sqrt(dot(normal, normal));
}

/** A facet of a cell, with its corners in ascending order. */
struct CellFacet
{
  std::int64_t vertex[3] = {}; ///< stream indices; the third one is 0 for an edge
  int order[3] = { 0, 1, 2 };  ///< the place of each among the facet's corners in the cell's order
};

/** The facet opposite to corner k of a cell with these corners. */
inline CellFacet facetOf(CellType type, const std::int64_t* corners, int k)
{
  CellFacet facet;
  for (int e = 0, other = 0; e < cornersOf(type); ++e)
  {
    if (e != k)
    {
      facet.vertex[other++] = corners[e];
    }
  }
  const auto sort = [&facet](int a, int b)
  {
    if (facet.vertex[a] > facet.vertex[b])
    {
      std::swap(facet.vertex[a], facet.vertex[b]);
      std::swap(facet.order[a], facet.order[b]);
    }
  };
  sort(0, 1);
  if (type == CellType::Tetrahedron)
  {
    sort(1, 2);
    sort(0, 1);
  }
  return facet;
}

/** A set of facets. */
class FacetSet
{
public:
  /** The corners of a facet in ascending order; the third one of an edge is 0. */
  using Corners = std::array<std::int64_t, 3>;

  FacetSet() = default;
  explicit FacetSet(std::vector<Corners> facets)
    : Sorted(std::move(facets))
  {
    std::ranges::sort(this->Sorted);
  }

  bool contains(const Corners& facet) const
  {
    return std::ranges::binary_search(this->Sorted, facet);
  }

private:
  std::vector<Corners> Sorted;
};

/** Items of `lanes` values of T that are created and released in any order. They are numbered from
 * 1; released slots are reused. */
template <class T>
class FreeList
{
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) >= sizeof(std::int32_t));

public:
  explicit FreeList(Pool& pool, int lanes = 1)
    : Owner(&pool)
    , Lanes(lanes)
  {
  }

  /** Creates an uninitialised item and returns its number. May move the others. */
  std::int32_t take()
  {
    const std::int32_t slot = this->Spare;
    if (slot != 0)
    {
      std::memcpy(&this->Spare, this->at(slot), sizeof(slot));
      return slot;
    }
    if (this->Used == this->Capacity)
    {
      this->grow();
    }
    return static_cast<std::int32_t>(++this->Used);
  }

  /** Releases the item. */
  void give(std::int32_t slot)
  {
    std::memcpy(this->at(slot), &this->Spare, sizeof(slot));
    this->Spare = slot;
  }

  T* at(std::int32_t slot) const
  {
    return reinterpret_cast<T*>(this->Memory.data()) +
           (static_cast<std::int64_t>(slot) - 1) * this->Lanes;
  }
  T& operator[](std::int32_t slot) const { return *this->at(slot); }

private:
  void grow()
  {
    constexpr std::int64_t First = 64;
    if (this->Used == INT32_MAX)
    {
      throw Error("too many cells are open at once: convert the mesh with the order bfs");
    }
    this->Capacity =
      std::min<std::int64_t>(INT32_MAX, std::max(First, this->Capacity + this->Capacity / 8));
    const auto bytes = static_cast<std::int64_t>(sizeof(T)) * this->Lanes * this->Capacity;
    this->Memory.grow(*this->Owner, static_cast<std::size_t>(bytes));
  }

  Pool* Owner;
  int Lanes;
  Buffer Memory;
  std::int64_t Used = 0, Capacity = 0;
  std::int32_t Spare = 0; // head of the linked list of free slots
};

/** The facets of the cells so far, stored with their lowest vertex until it is final. Those that
 * have only one cell by then are boundary facets. The caller may store a number with each facet. */
class SMG_EXPORT OpenFacets
{
public:
  explicit OpenFacets(Pool& pool)
    : Memory(&pool)
    , Heads(pool)
    , Facets(pool)
  {
  }

  /** Throws Error if more vertices are open than their low 32 bits distinguish. */
  void extend(std::int64_t vertices);
  void release(std::int64_t first) { this->Heads.release(first); }

  /** The result of add() for a facet that is added for the first time. */
  static constexpr std::int32_t Fresh = -1;

  /**
   * Adds a cell with the facet with these corners in ascending order (the third one 0 for an edge).
   * The first call returns Fresh and stores `data`, at least 0; the second call returns and
   * releases that; further calls return 0.
   */
  std::int32_t add(std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data);

  /** Instead of add(), where the number of cells does not matter: stores `data` with the facet
   * unless it is known, and returns its data. take() then finds facets of any number of cells. */
  std::int32_t join(std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data);

  /** Calls visit(middle, high, shared) for each facet with the lowest corner `low`; `shared`: it
   * has several cells. `high` is not set for an edge. */
  template <class Visit>
  void visit(std::int64_t low, Visit&& visit) const
  {
    const auto from = static_cast<std::uint32_t>(low);
    for (std::int32_t slot = this->Heads[low]; slot != 0; slot = this->Facets[slot].next)
    {
      const Facet& facet = this->Facets[slot];
      visit(low + (facet.middle - from), low + (facet.high - from), facet.data < 0);
    }
  }

  /** Calls found(middle, high, data) for each facet of exactly one cell whose lowest corner is
   * `low`, in the order in which they were first added. Releases all facets with this lowest
   * corner. Returns how many of them have more than two cells. */
  template <class Found>
  std::int64_t take(std::int64_t low, Found&& found)
  {
    const auto from = static_cast<std::uint32_t>(low);
    std::int64_t crowded = 0;
    for (std::int32_t slot = this->Heads[low]; slot != 0;)
    {
      const Facet facet = this->Facets[slot];
      this->Facets.give(slot);
      slot = facet.next;
      crowded += facet.data == Crowded ? 1 : 0;
      if (facet.data >= 0)
      {
        found(low + (facet.middle - from), low + (facet.high - from), facet.data);
      }
    }
    this->Heads[low] = 0;
    if (!this->Hubs.empty())
    {
      this->Hubs.erase(low);
    }
    return crowded;
  }

private:
  // Instead of the data of a facet: two cells have it, or more.
  static constexpr std::int32_t Shared = -1, Crowded = -2;

  struct Facet
  {
    std::uint32_t middle, high; ///< by their low 32 bits
    std::int32_t next;          ///< with the same lowest corner
    std::int32_t data;          ///< at least 0: of one cell

    bool isSame(const Facet& other) const
    {
      return this->middle == other.middle && this->high == other.high;
    }
    /** The result of add() for a facet that is known. */
    std::int32_t share()
    {
      const std::int32_t before = this->data;
      this->data = before >= 0 ? Shared : Crowded;
      return std::max(before, 0);
    }
  };

  /** A hash table of the list of a vertex that is too long to be walked for each cell. */
  struct Hub
  {
    Buffer table; ///< slots of facets by hash; 0: none; at least half of it is empty
    std::int32_t last = 0, facets = 0;
  };

  struct Found
  {
    std::int32_t slot;
    bool isNew;
  };

  Found findOrAdd(std::int64_t low, const Facet& facet);
  Found findInHub(std::int64_t low, const Facet& facet);
  Hub& hubOf(std::int64_t low);
  std::int32_t* place(const Hub& hub, const Facet& facet) const;
  void append(Hub& hub, std::int32_t slot);

  Pool* Memory;
  Ring<std::int32_t> Heads; ///< the first facet of a vertex; 0: none
  FreeList<Facet> Facets;
  std::unordered_map<std::int64_t, Hub> Hubs; ///< by vertex
};

/** Finds the boundary facets of a mesh stream in one pass: the facets of exactly one cell. Cells
 * that use a vertex twice or are flagged as duplicates do not count. */
class BoundaryFacets
{
public:
  BoundaryFacets(Pool& pool, CellType type)
    : Type(type)
    , Open(pool)
  {
  }

  /** Adds the next block and calls found(low, middle, high) for each boundary facet whose lowest
   * vertex is final, in the order of these; `high` is 0 for an edge. */
  template <class Found>
  void add(const MeshBlock& block, Found&& found)
  {
    this->Vertices = block.firstVertex + block.vertices();
    this->Open.extend(this->Vertices);
    this->addCells(block);
    this->take(block.finalized, found);
  }

  /** Calls found() for the other boundary facets, after the last block. */
  template <class Found>
  void finish(Found&& found)
  {
    this->take(this->Vertices, found);
  }

  /** The number of edges so far with exactly two triangles that run along it in the same direction:
   * these are wound against each other. */
  std::int64_t turnedEdges() const
  {
    return this->Turned + static_cast<std::int64_t>(this->MaybeTurned.size());
  }
  /** The facets of the cells so far, until their lowest vertex is final. */
  const OpenFacets& open() const { return this->Open; }

private:
  void addCells(const MeshBlock& block);

  template <class Found>
  void take(std::int64_t end, Found& found)
  {
    for (; this->Final < end; ++this->Final)
    {
      this->Open.take(this->Final, [&](std::int64_t middle, std::int64_t high, std::int32_t)
        { found(this->Final, middle, this->Type == CellType::Triangle ? 0 : high); });
    }
    this->Open.release(this->Final);
    const auto known = this->MaybeTurned.lower_bound({ this->Final, 0 });
    this->Turned += std::distance(this->MaybeTurned.begin(), known);
    this->MaybeTurned.erase(this->MaybeTurned.begin(), known);
  }

  CellType Type;
  OpenFacets Open;
  std::int64_t Vertices = 0, Final = 0, Turned = 0;
  /** Edges with two triangles so far that are wound against each other, until they are final: a
   * third triangle removes the edge, since it has no two sides then. */
  std::set<std::pair<std::int64_t, std::int64_t>> MaybeTurned;
};

} // namespace smg
