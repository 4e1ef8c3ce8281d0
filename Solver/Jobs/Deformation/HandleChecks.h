// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Deform.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** Throws Error unless the arrays have the sizes for this many vertices. */
SMG_EXPORT void checkSize(const VertexHandles& handles, std::int64_t vertices);

/** Throws Error if the values at held vertex `k` of the arrays, vertex `i` of the mesh, are not
 * finite or out of range. */
SMG_EXPORT void checkHeld(const VertexHandles& handles, std::size_t k, std::int64_t i);

} // namespace smg
