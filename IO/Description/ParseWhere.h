// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "smg/Export.h"
#include "smg/Problem.h"
#include "smg/Region.h"

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

/** The keys of places. */
inline constexpr std::array WhereKeys{ "halfspace", "box", "sphere", "vertices", "tag", "mask",
  "nearest", "boundary", "group", "all", "any", "not" };

/**
 * Reads the one of these members that exists in the object: `halfspace` [nx, ny, nz, d], `box` [x0,
 * y0, z0, x1, y1, z1], `sphere` [x, y, z, r], `vertices` [original numbers], `tag` ["column",
 * value], `mask` "column", `nearest` [[x, y, z], ...], `boundary` true, `group` "name", a number or
 * a list of these, `all` and `any` of a list of places, and `not` of a place. Throws Error if there
 * is more than one, or if it is invalid. `everywhere`: whether none is allowed; `listsEverywhere`:
 * whether it is a key that the caller takes.
 */
Where parseWhere(const JsonNode& object, bool everywhere = false, bool listsEverywhere = false);

/** The names of groups: a name, which may contain `*`, a number, or a list of these. Throws Error.
 */
std::vector<std::string> parseGroups(const JsonNode& node);

/** Throws Error unless the value is an object with no other keys than WhereKeys and these. */
void requireWhereAnd(const JsonNode& object, std::initializer_list<const char*> keys);

/** The weights named `cotangent` (or `raw-cotangent`), `clamped` and `uniform`; none for other
 * names. */
SMG_EXPORT std::optional<Weights> weightsOfName(std::string_view name);

/** The member `weights` of an object, if any. Throws Error. */
SMG_EXPORT std::optional<Weights> parseWeights(const JsonNode& object);

} // namespace smg
