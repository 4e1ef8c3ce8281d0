// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Groups.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace smg
{

/** Groups and sets as JSON: `{ "groups": [ { "of": "facets", "name": "inlet", "number": 3 } ],
 * "sets": [ [0] ] }`, with the sets from 1 on. */
nlohmann::json jsonOf(const MeshGroups& groups);

/** The groups that jsonOf() has described. Throws MeshError if it is no such
 * description. */
MeshGroups groupsOf(const nlohmann::json& json);

/** The most bytes of the text: groups are in memory. */
inline constexpr std::int64_t MaxGroupTextBytes = std::int64_t(64) << 20;

/** The same as text. */
SMG_EXPORT std::string textOf(const MeshGroups& groups);
SMG_EXPORT MeshGroups groupsOfText(const std::string& text);

} // namespace smg
