// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

class vtkPolyData;

namespace smg
{

/** Throws Error if no file of lines has that suffix. */
void checkLineFile(const std::filesystem::path& path);

/** Writes polylines with their arrays, as shortest paths, to a .vtp or .vtk file (`text`: in text),
 * or without arrays to an .obj file. The file is renamed when it is complete. Throws Error. */
void writeLines(vtkPolyData& lines, const std::filesystem::path& path, bool text);

} // namespace smg
