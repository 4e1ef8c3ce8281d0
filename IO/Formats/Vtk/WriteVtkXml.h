// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "smg/Export.h"
#include "smg/MeshSource.h"

#include <filesystem>

namespace smg
{

/**
 * Writes a mesh stream, which says its numbers of vertices and cells, as one VTK XML file: .vtp for
 * triangles, .vtu for triangles or tetrahedra, with all columns as point and cell data, points in
 * stream order (see VtkXmlFile.h). The data are written as they come, in the memory of a few
 * blocks.
 * @throws Error if the file cannot be written; Cancelled. Nothing is left of the file then.
 */
SMG_EXPORT void writeVtkXml(
  MeshSource& source, const std::filesystem::path& path, const ProgressFunction& progress = {});

} // namespace smg
