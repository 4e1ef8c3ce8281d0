// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

#include <filesystem>
#include <span>

namespace smg
{

/** Throws Error if the suffix of a file of paths is none of .vtp and .obj. */
SMG_EXPORT void checkPathFile(const std::filesystem::path& file);

/** Writes paths as polylines, in the order of the report, those without points left out: as VTK
 * polydata (.vtp) with the cell arrays To, From and Length, or as lines of .obj, where the path
 * from a source to itself is none. Throws Error. */
SMG_EXPORT void writePaths(const std::filesystem::path& file, std::span<const Report::Path> paths);

} // namespace smg
