// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/SolidSplit.h"

#include <algorithm>
#include <cassert>

namespace smg
{

namespace
{

using Face = std::array<int, 4>;

/** The faces of the solids in VTK's numbering, counterclockwise as seen from outside; -1: a
 * triangle. */
constexpr std::array<Face, 6> HexahedronFaces{ { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 },
  { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } } };
/** The first triangle of VTK's wedge faces outwards. */
constexpr std::array<Face, 5> WedgeFaces{ { { 0, 1, 2, -1 }, { 3, 5, 4, -1 }, { 0, 3, 4, 1 },
  { 1, 4, 5, 2 }, { 2, 5, 3, 0 } } };
constexpr std::array<Face, 5> PyramidFaces{ { { 0, 3, 2, 1 }, { 0, 1, 4, -1 }, { 1, 2, 4, -1 },
  { 2, 3, 4, -1 }, { 3, 0, 4, -1 } } };

std::span<const Face> facesOf(std::size_t corners)
{
  return corners == 8   ? std::span<const Face>(HexahedronFaces)
         : corners == 6 ? std::span<const Face>(WedgeFaces)
                        : std::span<const Face>(PyramidFaces);
}

} // namespace

TetrahedraOfSolid splitSolid(std::span<const std::int64_t> corners)
{
  assert(corners.size() == 8 || corners.size() == 6 || corners.size() == 5);
  // Joins all faces that do not contain the least corner with it: the faces that do are split from
  // it, and the solid is star-shaped from any corner.
  const std::int64_t apex = *std::ranges::min_element(corners);
  TetrahedraOfSolid result;
  for (const Face& face : facesOf(corners.size()))
  {
    const std::size_t sides = face[3] < 0 ? 3 : 4;
    std::array<std::int64_t, 4> ring{};
    for (std::size_t k = 0; k < sides; ++k)
    {
      ring[k] = corners[static_cast<std::size_t>(face[k])];
    }
    const auto end = ring.begin() + static_cast<std::ptrdiff_t>(sides);
    if (std::find(ring.begin(), end, apex) != end)
    {
      continue;
    }
    std::rotate(ring.begin(), std::min_element(ring.begin(), end), end);
    // Seen from the apex, inside, the face is clockwise.
    result.add(ring[0], ring[2], ring[1], apex);
    if (sides == 4)
    {
      result.add(ring[0], ring[3], ring[2], apex);
    }
  }
  return result;
}

} // namespace smg
