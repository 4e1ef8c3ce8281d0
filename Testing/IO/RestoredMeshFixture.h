// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/WriteFiles.h"
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/IO/MeshOfFile.h"
#include "Testing/Support/FileMesh.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace smg::testing
{

using Corners = std::vector<std::int64_t>;

/** Restores meshes from a mesh stream. */
class RestoredMeshFixture : public ::testing::Test
{
protected:
  /** The file restored from a mesh stream of the mesh. */
  FileMesh restored(const MeshOfFile& mesh, const std::string& suffix, std::uint64_t seed = 1)
  {
    this->write(mesh, "out" + suffix, seed);
    return readFileMesh(this->Folder / ("out" + suffix));
  }

  void write(const MeshOfFile& mesh, const std::string& name, std::uint64_t seed = 1)
  {
    writeVsmOf(mesh, this->Folder / "mesh.vsm", seed);
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    this->Notes = writeRestored(this->Folder / "mesh.vsm", this->Folder / name, workspace);
  }

  bool isNoted(const std::string& part) const
  {
    return std::ranges::any_of(this->Notes,
      [&part](const std::string& note) { return note.find(part) != std::string::npos; });
  }

  TemporaryFolder Folder;
  std::vector<std::string> Notes;
};

} // namespace smg::testing
