// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/Ring.h"
#include "Solver/Storage/Slots.h"

#include <cstdint>

namespace smg
{

/**
 * The facets of the cells that have come, kept with their lowest vertex until this is final: then
 * those that only one cell has are the boundary's. Each facet may carry a number of the caller's.
 */
class OpenFacets
{
public:
  explicit OpenFacets(Pool& pool)
    : Heads(pool)
    , Facets(pool)
  {
  }

  /** Throws Error if more vertices are open than their low 32 bits tell apart. */
  void extend(std::int64_t vertices);
  void release(std::int64_t first) { this->Heads.release(first); }

  /** What add() says of a facet that had come before. */
  static constexpr std::int32_t Fresh = -1;

  /**
   * One more cell has the facet with these corners in ascending order (the third one 0 for an
   * edge). The first time the answer is Fresh, and `data`, at least 0, is kept; the second time it
   * is that, which is let go of; then 0.
   */
  std::int32_t add(std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data);

  /**
   * Calls found(middle, high, data) for each facet with the lowest corner `low` that one cell has,
   * in the order in which they came, and forgets all with this corner.
   */
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
  }

private:
  static constexpr std::int32_t Shared = -1;

  struct Facet
  {
    std::uint32_t middle, high; ///< by their low 32 bits
    std::int32_t next;          ///< of the same lowest corner
    std::int32_t data;          ///< Shared: more than one cell has it
  };

  Ring<std::int32_t> Heads; ///< the first facet of a vertex; 0: none
  Slots<Facet> Facets;
};

} // namespace smg
