// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/MeshPart.h"
#include "IO/Raw/RawMeshBuilder.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

#include <filesystem>

namespace smg
{

/** How to read a mesh. */
struct ImportOptions
{
  CellChoice cells = CellChoice::Only;
  ProgressFunction progress;
  MeshPart part = {};
};

/**
 * Parses a mesh file of any format that formats() has a parser for, or one of them compressed by
 * gzip. The format is recognised by the content, by the suffix only where the content leaves it
 * open.
 * @throws Error naming the file and the line, record or byte: the format is not known, the file is
 * empty, truncated or contradicts itself, a coordinate is not finite, a corner is no vertex, there
 * are no cells, or both triangles and tetrahedra, there is no such part; Cancelled.
 */
SMG_EXPORT RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options = {});

} // namespace smg
