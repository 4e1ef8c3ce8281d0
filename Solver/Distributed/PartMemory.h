// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/** The memory that a process needs for a part of a mesh, bytes: for the part itself, its assembly,
 * its rows of the matrix and their hierarchy. An upper estimate, calibrated by the measurements of
 * docs/cluster.md. */
SMG_EXPORT double partMemory(std::int64_t vertices, std::int64_t cells, int columns);

/** Throws Error if that is more than the limit. */
void checkPartMemory(std::int64_t vertices, std::int64_t cells, int columns, std::int64_t limit);

} // namespace smg
