// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FolderLock.h"
#include "smg/Convert.h"

#include <filesystem>
#include <memory>

namespace smg
{

/** A mesh file converted in the folder of a checkpoint. */
struct CheckpointedConversion
{
  std::filesystem::path mesh;       ///< the .vsm file
  std::shared_ptr<FolderLock> lock; ///< of the folder, as long as the mesh is used
  ConversionReport report;
};

/**
 * Converts a mesh file to a .vsm file in the folder ConversionOptions::checkpoint, unless the same
 * conversion has been completed there. Throws Error as convert(), and if the folder has another
 * conversion or computation, other files, or is in use; then it is left as it is.
 */
CheckpointedConversion convertInCheckpoint(
  const std::filesystem::path& in, const ConversionOptions& options);

/** Throws Error if a folder has a conversion of convertInCheckpoint(), which another command is to
 * continue. */
void requireNoConversionIn(const std::filesystem::path& folder);

} // namespace smg
