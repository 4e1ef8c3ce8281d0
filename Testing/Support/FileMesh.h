// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace smg::testing
{

/** The content of a mesh file, read by minimal readers for the output of the library. */
struct FileMesh
{
  std::vector<double> points;                   ///< x, y, z per point
  std::vector<std::vector<std::int64_t>> cells; ///< corners of each cell cell
  /** Values of the attributes, all components; in PLY, by the name of the property. */
  std::map<std::string, std::vector<double>> pointData, cellData;
};

/** Reads a file of the library, by its suffix: .ply, .vtp, .vtu, .vtk (binary), .obj, .off, .mesh,
 * .msh, .inp, .e. Throws std::exception if the file is not as expected. */
FileMesh readFileMesh(const std::filesystem::path& path);

/** Reads a .stl file, text or binary: three points per triangle. */
std::vector<double> readStlPoints(const std::filesystem::path& path);

} // namespace smg::testing
