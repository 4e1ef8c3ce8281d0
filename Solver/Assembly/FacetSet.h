// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace smg
{

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

} // namespace smg
