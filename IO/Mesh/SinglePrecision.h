// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/**
 * The position of vertex `vertex` in the single precision of `what`, a file or mesh. Throws Error,
 * which names both, if a coordinate is too large for it or not finite.
 */
SMG_EXPORT std::array<float, 3> singlePrecision(
  std::span<const double, 3> position, std::int64_t vertex, const std::string& what);

} // namespace smg
