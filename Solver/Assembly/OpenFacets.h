// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "Solver/Memory/Slots.h"
#include "smg/Export.h"

#include <cstdint>
#include <unordered_map>
#include <utility>

namespace smg
{

/** The facets of the cells so far, stored with their lowest vertex until this is final: facets of
 * only one cell are then boundary facets. Each facet may have a number of the caller. */
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

  /** Instead of add(), where all cells of a facet count: stores `data` with the facet unless it is
   * known, and returns its data. take() then finds facets of any number of cells. */
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
      visit(low + (facet.middle - from), low + (facet.high - from), facet.data == Shared);
    }
  }

  /** Calls found(middle, high, data) for each facet of exactly one cell with the lowest corner
   * `low`, in the order of their first call, and releases all facets with this corner. */
  template <class Found>
  void take(std::int64_t low, Found&& found)
  {
    const auto from = static_cast<std::uint32_t>(low);
    for (std::int32_t slot = this->Heads[low]; slot != 0;)
    {
      const Facet facet = this->Facets[slot];
      this->Facets.give(slot);
      slot = facet.next;
      if (facet.data != Shared)
      {
        found(low + (facet.middle - from), low + (facet.high - from), facet.data);
      }
    }
    this->Heads[low] = 0;
    if (!this->Hubs.empty())
    {
      this->Hubs.erase(low);
    }
  }

private:
  static constexpr std::int32_t Shared = -1;

  struct Facet
  {
    std::uint32_t middle, high; ///< by their low 32 bits
    std::int32_t next;          ///< with the same lowest corner
    std::int32_t data;          ///< Shared: of several cells

    bool isSame(const Facet& other) const
    {
      return this->middle == other.middle && this->high == other.high;
    }
    /** The result of add() for a facet that is known. */
    std::int32_t share()
    {
      const std::int32_t before = std::exchange(this->data, Shared);
      return before == Shared ? 0 : before;
    }
  };

  /** An index of the list of a vertex that is too long to be walked for each cell. */
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
  Slots<Facet> Facets;
  std::unordered_map<std::int64_t, Hub> Hubs; ///< by vertex
};

} // namespace smg
