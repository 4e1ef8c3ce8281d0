// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InputFile.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Format.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace smg::testing
{

/** Expects that a parser which only looks at a file finds the type of the cells of the mesh. */
inline void expectLook(
  const std::filesystem::path& path, CellChoice cells, const Format& format, const RawMesh& mesh)
{
  Workspace workspace({}, Workspace::MinMemory);
  RawMeshBuilder builder(workspace, cells, RawMeshBuilder::Look);
  InputFile file(path);
  try
  {
    format.parse(file, builder, {}, {});
    builder.finish(); // of triangles only the end tells that no tetrahedron follows
    ADD_FAILURE() << "no cell is found";
  }
  catch (const CellTypeFound& found)
  {
    EXPECT_EQ(found.type, mesh.cellType);
  }
}

} // namespace smg::testing
