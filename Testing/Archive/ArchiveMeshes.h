// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/Refinement.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Convert.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

namespace smg::testing
{

/** The folder of the archive's meshes; empty if there is none. */
inline const std::filesystem::path Archive = archiveFolder();

/** The mesh in breadth-first order. */
inline StreamMesh archiveMesh(const std::string& name)
{
  const TemporaryFolder scratch;
  ConversionOptions options;
  options.scratch = scratch.path();
  if (name.ends_with(".mesh"))
  {
    options.cells = CellChoice::Tetrahedra; // the file may hold triangles as well
  }
  const std::unique_ptr<OpenedMesh> opened = openMesh(Archive / name, options);
  const std::unique_ptr<MeshSource> source = opened->reader().source();
  return collect(*source);
}

/** The armadillo of 43K vertices refined `levels` times. */
inline IndexedTestMesh refinedArmadillo(int levels)
{
  const StreamMesh coarse = archiveMesh("armadillo43k.obj");
  IndexedTestMesh mesh{ coarse.cellType, coarse.positions, coarse.corners };
  for (int l = 0; l < levels; ++l)
  {
    mesh = refined(mesh);
  }
  return mesh;
}

/** A test that is skipped if there is no archive. */
template <class Base>
class NeedsArchive : public Base
{
protected:
  void SetUp() override
  {
    if (Archive.empty())
    {
      GTEST_SKIP() << "SMG_TEST_DATA_DIR is empty";
    }
  }
};

} // namespace smg::testing
