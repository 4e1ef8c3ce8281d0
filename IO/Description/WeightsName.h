// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "smg/Export.h"
#include "smg/Problem.h"

#include <optional>
#include <string_view>

namespace smg
{

/** The weights named `cotangent` (or `raw-cotangent`), `clamped` and `uniform`; none for other
 * names. */
SMG_EXPORT std::optional<Weights> weightsOfName(std::string_view name);

/** The member `weights` of an object, if any. Throws Error. */
std::optional<Weights> parseWeights(const JsonNode& object);

} // namespace smg
