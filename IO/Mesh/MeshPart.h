// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace smg
{

/** The part to read of a file with several time steps or partitions; both from 0. */
struct MeshPart
{
  std::int64_t timeStep = 0; ///< a mesh without time steps is step 0
  /** Of the time step; none: all partitions, joined. */
  std::optional<std::int64_t> partition;
};

/** For files without time steps and partitions: throws Error, which begins with the name of the
 * file, if `part` requests one. */
void checkIsWhole(const MeshPart& part, const std::string& name);

} // namespace smg
