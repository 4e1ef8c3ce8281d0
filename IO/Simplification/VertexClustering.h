// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Simplification/SurfaceParts.h"

#include <cstddef>

namespace smg
{

/** Merges vertices that are near one another, whatever surface they belong to, into at most
 * `vertices`: for surfaces whose edges cannot be collapsed since their triangles do not share
 * vertices. */
void clusterVertices(SurfacePart& part, std::size_t vertices);

} // namespace smg
