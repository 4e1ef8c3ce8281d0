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

/** The most vertices that a process can own: hypre counts the entries of its rows, in all levels
 * less than 64 times as many, by a HYPRE_Int. */
SMG_EXPORT std::int64_t mostPartVertices();

/** Throws Error if partMemory() is more than the limit. */
void checkPartMemory(std::int64_t vertices, std::int64_t cells, int columns, std::int64_t limit);

} // namespace smg
