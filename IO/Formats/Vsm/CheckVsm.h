// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "smg/Export.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/**
 * Reads a whole .vsm file, unlike all other operations, and verifies the checksum of every column
 * of every block.
 * @return the number of blocks
 * @throws Error naming the file, the table and the block if one is wrong; Cancelled
 */
SMG_EXPORT std::int64_t checkVsm(
  const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
