// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace smg
{

/**
 * Whether a triangle or tetrahedron is degenerate: a corner is repeated, or its area or volume is
 * zero but for rounding (1e-14 of what its longest edge allows).
 * @param corners 3 or 4 indices
 * @param points the coordinates of these corners
 */
bool isDegenerate(
  std::span<const std::int64_t> corners, std::span<const std::array<double, 3>> points);

/** Six times the volume of a tetrahedron; negative if its corners are in the other order. */
double orientedVolume(const std::array<std::array<double, 3>, 4>& points);

} // namespace smg
