// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/TestMeshes.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace smg::testing
{

/** Writes the bytes as a file. */
inline void writeBytes(const std::filesystem::path& path, std::string_view bytes)
{
  // Writing over a file would wait for the disk on some file systems.
  std::filesystem::remove(path);
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/** A number with all its digits. */
inline std::string exact(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

/** The mesh as the text of an OFF file (triangles) or a Medit file (tetrahedra). */
inline std::string meshText(const IndexedTestMesh& mesh)
{
  const bool triangles = mesh.cellType == CellType::Triangle;
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::string text =
    triangles
      ? "OFF\n" + std::to_string(mesh.vertices()) + ' ' + std::to_string(mesh.cells()) + " 0\n"
      : "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(mesh.vertices()) + '\n';
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
  {
    text += exact(mesh.positions[i]);
    text += i % 3 < 2 ? " " : triangles ? "\n" : " 0\n";
  }
  text += triangles ? "" : "Tetrahedra\n" + std::to_string(mesh.cells()) + '\n';
  for (std::size_t i = 0; i < mesh.corners.size(); i += corners)
  {
    text += triangles ? "3" : "";
    for (std::size_t k = 0; k < corners; ++k)
    {
      text += k > 0 || triangles ? " " : "";
      text += std::to_string(mesh.corners[i + k] + !triangles);
    }
    text += triangles ? "\n" : " 0\n";
  }
  return triangles ? text : text + "End\n";
}

} // namespace smg::testing
