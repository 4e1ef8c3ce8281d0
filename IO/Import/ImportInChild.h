// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/Importer.h"

#include <filesystem>

namespace smg
{

/**
 * Runs an importer in a process of its own, whose memory and CPU time are limited, and takes over
 * the mesh: VTK's readers trust a file, so a damaged one can make them crash, hang or ask for any
 * amount of memory. Only for programs that have no other thread at that time, as a command-line
 * program has.
 * @throws Error as the importer, or if it crashed or exceeded its limits; Cancelled
 */
IndexedMesh importInChild(VtkImporter importer, const std::filesystem::path& path,
  MeshFormat format, const ImportOptions& options);

} // namespace smg
