// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/StreamSimplifier.h"

#include <string>
#include <vector>

// What simplifications and previews say of their results.

namespace smg
{

/** Says how many bodies are left out. */
void noteBodies(const StreamSimplifier& simplifier, std::vector<std::string>& notes);

/** Says how many vertices were merged, and where area is lost by that, or by triangles that turn
 * over. `coincide`: whether there are points that could be joined. */
void noteShape(const StreamSimplifier& simplifier, bool coincide, std::vector<std::string>& notes);

} // namespace smg
