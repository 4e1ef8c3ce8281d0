// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace smg
{

/** What to read of a file that has a mesh at several times, or in partitions; both from 0. */
struct MeshPart
{
  std::int64_t timeStep = 0; ///< a mesh without time steps is its step 0
  /** Of the time step; none: all partitions, joined. */
  std::optional<std::int64_t> partition;
};

/** For files that have neither time steps nor partitions: throws Error, which begins with the
 * file's name, if `part` asks for one. */
void checkIsWhole(const MeshPart& part, const std::string& name);

} // namespace smg
