// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstddef>
#include <cstdint>

namespace smg
{

/**
 * Throws Error unless a solution of `vertices` vertices has those from `first` on, `count` of them,
 * and there is room for the values of as many.
 */
SMG_EXPORT void checkVertexRange(
  std::int64_t first, std::int64_t count, std::size_t room, std::int64_t vertices);

} // namespace smg
