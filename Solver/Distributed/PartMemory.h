// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** The memory in bytes that a process needs for a part of a mesh: the part itself, its assembly,
 * its rows of the matrix and their hierarchy. An upper estimate, calibrated by the measurements of
 * docs/cluster.md. */
SMG_EXPORT double partMemory(std::int64_t vertices, std::int64_t cells, int columns);

/** The most vertices that a process can own. hypre counts the entries of its rows by a HYPRE_Int;
 * in all levels there are fewer than 64 for each vertex. */
SMG_EXPORT std::int64_t maxPartVertices();

/** Throws Error if partMemory() is more than the limit. */
void checkPartMemory(std::int64_t vertices, std::int64_t cells, int columns, std::int64_t limit);

/**
 * The memory in bytes that this process and those of its control group can still get without
 * swapping; 0: not known. That is the free memory of the machine or, if it is less, what the limits
 * of the control groups leave, which queueing systems and containers set (memory.max of version 2,
 * memory.limit_in_bytes of version 1). Files that these groups have in the page cache count as
 * free.
 * @param root the folder that has /proc and /sys
 */
SMG_EXPORT std::int64_t freeMemory(const std::filesystem::path& root = "/");

/** The smallest share in bytes of the free memory of its machine that a process can have, over all
 * machines. Called on all processes. */
SMG_EXPORT double freeMemoryOfProcess(Team& team);

} // namespace smg
