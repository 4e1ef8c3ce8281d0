// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/MeshPart.h"
#include "Solver/Core/Progress.h"
#include "smg/Export.h"

#include <filesystem>

namespace smg
{

/** Options of importMesh(). */
struct ImportOptions
{
  CellChoice cells = CellChoice::Only;
  ProgressFunction progress;
  MeshPart part = {};
};

/**
 * Parses a mesh file of any format in formats() with a parser, optionally compressed by gzip. The
 * format is detected from the content, and from the suffix only if the content is ambiguous.
 * @throws Error with the file and the line, record or byte: the format is unknown, the file is
 * empty, truncated or inconsistent, a coordinate is not finite, a corner is not a vertex, there are
 * no cells, both triangles and tetrahedra, or no such part; Cancelled.
 */
SMG_EXPORT RawMesh importMesh(
  const std::filesystem::path& path, Workspace& workspace, const ImportOptions& options = {});

} // namespace smg
