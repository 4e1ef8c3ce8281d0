// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "smg/Region.h"

#include <array>
#include <initializer_list>

namespace smg
{

/** The keys of places. */
inline constexpr std::array WhereKeys{ "halfspace", "box", "sphere", "vertices", "tag", "mask",
  "nearest", "boundary" };

/**
 * Reads the one of these members that exists in the object: `halfspace` [nx, ny, nz, d], `box` [x0,
 * y0, z0, x1, y1, z1], `sphere` [x, y, z, r], `vertices` [original numbers], `tag` ["column",
 * value], `mask` "column", `nearest` [[x, y, z], ...] and `boundary` true. Throws Error if there is
 * more than one, or if it is invalid. `everywhere`: whether none is allowed.
 */
Where parseWhere(const JsonNode& object, bool everywhere = false);

/** Throws Error unless the value is an object with no other keys than WhereKeys and these. */
void requireWhereAnd(const JsonNode& object, std::initializer_list<const char*> keys);

} // namespace smg
