// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <filesystem>
#include <string>
#include <vector>

namespace smg
{

/**
 * Writes a .vsm file in the order of the file that it was made of, which its columns OriginalId and
 * OriginalCellId tell: the same points, also those of no cell, and the same cells, polygons as
 * polygons, in the same order (see RestoredMesh.h). Works out of core, in the memory and folder of
 * the workspace, and tells its progress.
 *
 * The format goes by the suffix: .ply, .vtp, .vtu and .vtk with all columns; .obj, .off, .mesh,
 * .msh and .node with .ele with those that they have a place for (see AttributeNames.h); .stl
 * without. Tetrahedra go to .vtu, .vtk, .mesh, .msh and .node with .ele. Numbers in text read back
 * exactly.
 * @return a sentence for each thing that the file does not hold as the mesh has it
 * @throws Error if checkRestoredPath() does, the original order is not known (see RestoredMesh), or
 * a file cannot be read or written; Cancelled. Nothing is left of the output then.
 */
SMG_EXPORT std::vector<std::string> writeRestored(
  const std::filesystem::path& vsm, const std::filesystem::path& out, Workspace& workspace);

/** Throws Error unless writeRestored() writes files of this name with these cells. */
SMG_EXPORT void checkRestoredPath(const std::filesystem::path& path, CellType cellType);

} // namespace smg
