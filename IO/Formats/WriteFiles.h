// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/** Memory of a writer that sorts (Format::scratch) for a file in stream order, bytes. */
inline constexpr std::int64_t StreamOrderMemory = std::int64_t(64) << 20;

/**
 * Writes a .vsm file in the order of its original file, according to its columns OriginalId and
 * OriginalCellId: the same points, including those of no cell, and the same cells, polygons as
 * polygons, in the same order (see RestoredMesh.h). Works out of core, with the memory and folder
 * of the workspace, and reports its progress.
 *
 * The suffix selects the format, which takes the columns that it supports (see IO/Mesh/Columns.h).
 * Numbers in text read back exactly. `text`: as WriteMeshOptions::text.
 * @return a note for each part of the mesh that the file cannot represent exactly
 * @throws Error if checkRestoredPath() does, the original order is unknown (see RestoredMesh), or a
 * file cannot be read or written; Cancelled. No part of the output is left then.
 */
SMG_EXPORT std::vector<std::string> writeRestored(const std::filesystem::path& vsm,
  const std::filesystem::path& out, Workspace& workspace, bool text = false);

/** Throws Error unless writeRestored() can write files of this name with these cells. */
SMG_EXPORT void checkRestoredPath(const std::filesystem::path& path, CellType cellType);

} // namespace smg
