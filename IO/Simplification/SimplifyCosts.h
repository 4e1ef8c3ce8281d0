// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Estimate/Costs.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>

namespace smg
{

/** Throws Error unless simplify() can write a file of this name. */
SMG_EXPORT void checkSimplifiedPath(const std::filesystem::path& path);

/** The costs of simplify() on a stream, from its counts. */
SMG_EXPORT Costs simplifyCosts(const StreamInfo& info, std::int64_t memoryLimit);

} // namespace smg
