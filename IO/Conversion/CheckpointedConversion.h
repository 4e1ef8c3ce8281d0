// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Convert.h"

#include <filesystem>

namespace smg
{

/** A mesh file converted in the folder of a checkpoint. */
struct CheckpointedConversion
{
  std::filesystem::path mesh; ///< the .vsm file
  ConversionReport report;
};

/**
 * Converts a mesh file to a .vsm file in the folder ConversionOptions::checkpoint, unless the same
 * conversion has been completed there. Throws Error as convert(), and if the folder has another
 * conversion, other files, or is in use; then it is left as it is.
 */
CheckpointedConversion convertInCheckpoint(
  const std::filesystem::path& in, const ConversionOptions& options);

} // namespace smg
