// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Conversion/JobEstimate.h"
#include "smg/Export.h"
#include "smg/Simplify.h"

#include <filesystem>

namespace smg
{

/** Throws Error unless simplify() can write a file of this name. */
SMG_EXPORT void checkSimplifiedPath(const std::filesystem::path& path);

/** What simplify() of `mesh` to the file `out` is expected to cost; without a number of vertices at
 * most, for a result as large as the mesh. Of `conversion` the folder for scratch files counts.
 * Throws Error if the options are not those of a simplification. */
SMG_EXPORT JobEstimate simplifyEstimate(const EstimatedInput& mesh,
  const std::filesystem::path& out, const SimplifyOptions& options,
  const ConversionOptions& conversion);

} // namespace smg
