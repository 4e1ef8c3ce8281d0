// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstddef>
#include <cstdint>

namespace smg
{

/** Throws Error unless [first, first + count) is a range of a solution of `vertices` vertices and
 * there is room for its values. */
SMG_EXPORT void checkVertexRange(
  std::int64_t first, std::int64_t count, std::size_t room, std::int64_t vertices);

} // namespace smg
