// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>

namespace smg
{

/** Merges vertices that are near one another, wherever they belong, into at most so many: for
 * surfaces of which the edges cannot be collapsed, since triangles do not share vertices. */
void clusterVertices(SurfacePart& part, std::size_t vertices);

} // namespace smg
