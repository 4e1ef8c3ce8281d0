// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/Refinement.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace smg::testing
{

IndexedTestMesh refined(const IndexedTestMesh& triangles)
{
  IndexedTestMesh fine = triangles;
  fine.corners.clear();
  const std::int64_t vertices = triangles.vertices();
  std::unordered_map<std::int64_t, std::int64_t> midpoints;
  midpoints.reserve(static_cast<std::size_t>(2 * triangles.cells()));
  const auto midpoint = [&](std::int64_t a, std::int64_t b)
  {
    if (a > b)
    {
      std::swap(a, b);
    }
    const auto [place, isNew] = midpoints.try_emplace(a * vertices + b, fine.vertices());
    for (int k = 0; isNew && k < 3; ++k)
    {
      fine.positions.push_back(0.5 * (triangles.positions[static_cast<std::size_t>(3 * a + k)] +
                                       triangles.positions[static_cast<std::size_t>(3 * b + k)]));
    }
    return place->second;
  };
  for (std::size_t c = 0; c < triangles.corners.size(); c += 3)
  {
    const std::int64_t* v = triangles.corners.data() + c;
    const std::int64_t m[3] = { midpoint(v[0], v[1]), midpoint(v[1], v[2]), midpoint(v[2], v[0]) };
    fine.corners.insert(fine.corners.end(),
      { v[0], m[0], m[2], m[0], v[1], m[1], m[2], m[1], v[2], m[0], m[1], m[2] });
  }
  return fine;
}

} // namespace smg::testing
