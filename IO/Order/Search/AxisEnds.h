// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/**
 * Which of a number of points are at the ends of their two longest principal axes: four sets, less
 * than that if an axis has no extent.
 * @param points x, y, z each
 * @param chosen which of them count, at least one
 * @return sets of at least two of the chosen points
 */
std::vector<std::vector<std::uint32_t>> axisEnds(
  std::span<const float> points, std::span<const std::uint32_t> chosen);

} // namespace smg
