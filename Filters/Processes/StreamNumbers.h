// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The points of each process in a numbering in which those of a process are consecutive. */
struct StreamNumbers
{
  std::vector<std::int64_t> numbers; ///< of each point of this process
  std::int64_t first = 0, end = 0;   ///< of the points that this process owns
  std::int64_t total = 0;            ///< number of different points of all processes
};

/**
 * Numbers the points of all processes, which are the same wherever their global ids are. A point is
 * owned by the first of the processes whose cells use it; those of a process are numbered by
 * ascending ids. The pieces of a mesh stream keep their numbers. Called on all processes.
 * @param team the processes
 * @param ids the global id of each point of this process, any numbers from 0 on
 * @param isUsed of each of these, whether a cell of this process uses it
 * @throws Error if an id is negative, or no cell of any process uses a point
 */
StreamNumbers numberPoints(
  Team& team, std::span<const std::int64_t> ids, std::span<const char> isUsed);

} // namespace smg
