// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/WriteFiles.h"
#include "Testing/IO/ImportFixture.h"
#include "smg/Convert.h"
#include "smg/WriteMesh.h"

#include <fstream>
#include <iterator>
#include <string>

namespace smg::testing
{
namespace
{

/** Two tetrahedra with materials, facets, and sets of nodes. */
const std::string AbaqusSolid =
  "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n"
  "*ELEMENT, TYPE=C3D4, ELSET=copper\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=Air gap\n"
  "2, 2, 3, 4, 5\n*ELSET, ELSET=all\n1, 2\n*NSET, NSET=held\n1, 5\n"
  "*SURFACE, NAME=inlet\n1, S1\n2, S3\n*SURFACE, NAME=between\n1, S3\n"
  "*SURFACE, NAME=both\n1, S1\n1, S3\n";
const std::string AbaqusSurface =
  "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 1, 1, 0\n*ELEMENT, TYPE=S3, ELSET=plate\n"
  "1, 1, 2, 3\n2, 2, 4, 3\n*NSET, NSET=held\n1\n*SURFACE, NAME=rim\n1, E1\n2, E2\n";

const GroupCounts OfSolid{ { "cells copper", 1 }, { "cells Air gap", 1 }, { "cells all", 2 },
  { "vertices held", 2 }, { "facets inlet", 2 }, { "facets between", 1 }, { "facets both", 2 } };
const GroupCounts OfSurface{ { "cells plate", 2 }, { "vertices held", 1 }, { "facets rim", 2 } };

using GroupRoundTrip = ImportFixture;

} // namespace

TEST_F(GroupRoundTrip, GroupsComeBack)
{
  for (const bool isSolid : { true, false })
  {
    const GroupCounts& expected = isSolid ? OfSolid : OfSurface;
    writeBytes(this->Folder / "in.inp", isSolid ? AbaqusSolid : AbaqusSurface);
    convert(this->Folder / "in.inp", this->Folder / "mesh.vsm");
    for (const char* name : { "a.inp", "a.vtu", "a.vtk", "a.vtkhdf", "a.vtp" })
    {
      if (isSolid && std::string(name) == "a.vtp")
      {
        continue;
      }
      SCOPED_TRACE(name);
      writeFromVsm(this->Folder / "mesh.vsm", this->Folder / name, {}, {}, false);
      EXPECT_EQ(groupCounts(this->readFile(this->Folder / name)), expected);
      // And through the container, as a file of another program.
      convert(this->Folder / name, this->Folder / "again.vsm");
      writeFromVsm(this->Folder / "again.vsm", this->Folder / "again.vtu", {}, {}, false);
      EXPECT_EQ(groupCounts(this->readFile(this->Folder / "again.vtu")), expected);
    }
    writeFromVsm(this->Folder / "mesh.vsm", this->Folder / "text.vtk", {}, {}, true);
    EXPECT_EQ(groupCounts(this->readFile(this->Folder / "text.vtk")), expected);
    Workspace workspace(this->Folder.path(), Workspace::MinMemory);
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "restored.inp", workspace, false);
    EXPECT_EQ(groupCounts(this->readFile(this->Folder / "restored.inp")), expected);
  }
}

TEST_F(GroupRoundTrip, ArraysOfOtherGroupsAreLeftOut)
{
  writeBytes(this->Folder / "in.inp", AbaqusSolid);
  convert(this->Folder / "in.inp", this->Folder / "mesh.vsm");
  writeFromVsm(this->Folder / "mesh.vsm", this->Folder / "a.vtk", {}, {}, true);
  std::ifstream file(this->Folder / "a.vtk");
  std::string text{ std::istreambuf_iterator<char>(file), {} };
  const std::string sets = "%22sets%22:[";
  ASSERT_NE(text.find(sets), std::string::npos);
  std::string damaged = text;
  damaged.insert(damaged.find(sets) + sets.size(), "[99],");
  EXPECT_TRUE(groupCounts(this->read("b.vtk", damaged)).empty());
  text.replace(text.find("%22sets%22"), 10, "%22none%22");
  EXPECT_TRUE(groupCounts(this->read("c.vtk", text)).empty());
}

} // namespace smg::testing
