// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/OpenFacets.h"

#include "smg/Error.h"

#include <utility>

namespace smg
{

void OpenFacets::extend(std::int64_t vertices)
{
  if (vertices - this->Heads.first() > INT32_MAX)
  {
    throw Error("too many vertices are open at once: convert the mesh with the order bfs");
  }
  this->Heads.extend(vertices);
}

std::int32_t OpenFacets::add(
  std::int64_t low, std::int64_t middle, std::int64_t high, std::int32_t data)
{
  const auto m = static_cast<std::uint32_t>(middle);
  const auto h = static_cast<std::uint32_t>(high);
  std::int32_t last = 0;
  for (std::int32_t slot = this->Heads[low]; slot != 0;)
  {
    Facet& facet = this->Facets[slot];
    if (facet.middle == m && facet.high == h)
    {
      const std::int32_t before = std::exchange(facet.data, Shared);
      return before == Shared ? 0 : before;
    }
    last = slot;
    slot = facet.next;
  }
  const std::int32_t slot = this->Facets.take();
  this->Facets[slot] = { m, h, 0, data };
  (last == 0 ? this->Heads[low] : this->Facets[last].next) = slot;
  return Fresh;
}

} // namespace smg
