// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <vector>

namespace smg::testing
{

TEST(OpenMesh, RefusesToChangeAStreamFile)
{
  const TemporaryFolder folder;
  const StreamMesh mesh = toStream(grid(3, 3));
  MemorySource source(mesh);
  writeVsm(source, folder / "a.vsm");
  EXPECT_EQ(openMesh(folder / "a.vsm")->reader().info().cells, mesh.cells());
  std::vector<ConversionOptions> all(4);
  all[0].cells = CellChoice::Triangles;
  all[1].weld = 0.0;
  all[2].timeStep = 1;
  all[3].partition = 0;
  for (const ConversionOptions& options : all)
  {
    expectError(
      [&] { openMesh(folder / "a.vsm", options); }, "a.vsm: a .vsm file is read as it is");
  }
}

} // namespace smg::testing
