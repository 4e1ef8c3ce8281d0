// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace smg::testing
{

/** What a mesh file says, read by readers that know just what the library writes. */
struct FileMesh
{
  std::vector<double> points;                   ///< x, y, z of each
  std::vector<std::vector<std::int64_t>> cells; ///< corners of each
  /** Values of the attributes, all components; in PLY, by the name of the property. */
  std::map<std::string, std::vector<double>> pointData, cellData;
};

/**
 * Reads a file of the library, by its suffix: .ply, .vtp, .vtu, .vtk (binary), .obj, .off, .mesh,
 * .msh. Throws std::exception where the file is not as expected.
 */
FileMesh readFileMesh(const std::filesystem::path& path);

/** Reads a .stl file, text or binary: three points a triangle. */
std::vector<double> readStlPoints(const std::filesystem::path& path);

} // namespace smg::testing
