// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace smg::testing
{

using Indices = std::set<std::int64_t>;

inline std::span<const double, 3> pointOf(const std::vector<double>& numbers, std::int64_t i)
{
  return std::span(numbers).subspan(3 * static_cast<std::size_t>(i)).first<3>();
}

/** The vertices within `rings` edges, by one loop over all cells per ring. */
inline Indices ringsOf(const StreamMesh& mesh, std::int64_t vertex, int rings)
{
  Indices found{ vertex };
  const int corners = cornersOf(mesh.cellType);
  for (int ring = 0; ring < rings; ++ring)
  {
    const Indices before = found;
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      const auto* corner = mesh.corners.data() + c * corners;
      if (std::any_of(
            corner, corner + corners, [&before](std::int64_t v) { return before.count(v) != 0; }))
      {
        found.insert(corner, corner + corners);
      }
    }
  }
  return found;
}

} // namespace smg::testing
