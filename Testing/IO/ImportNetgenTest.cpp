// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/VolumeImport.h"

#include <string>

namespace smg::testing
{
namespace
{

const std::string NetgenMesh =
  "# a comment\nmesh3d\ndimension\n3\ngeomtype\n0\n\n# surfnr bcnr domin domout np p1 p2 p3\n"
  "surfaceelementsgi\n2\n1 2 1 0 3 1 2 3 0 0 0\n2 3 1 0 3 1 2 4 0 0 0\n\n"
  "volumeelements\n2\n1 4 1 3 2 4\n7 4 2 4 3 5\n\n"
  "edgesegmentsgi2\n1\n1 0 1 2 -1 -1 0 0 1 0 1 1\n\n"
  "points\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n\n"
  "materials\n2\n1 copper\n7 default\n\nbcnames\n2\n2 heated side\n3 default\n\nendmesh\n";

class ImportNetgen : public VolumeImport
{
protected:
  ReadMesh netgen(const std::string& text) { return this->read(NetgenFormat, "a.vol", text); }
};

std::string replacedFirst(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

} // namespace

TEST_F(ImportNetgen, MaterialsAndConditionsAreGroups)
{
  const ReadMesh mesh = this->netgen(NetgenMesh);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  for (const double volume : tetrahedronVolumes(mesh))
  {
    EXPECT_GT(volume, 0);
  }
  EXPECT_EQ(groupCounts(mesh), (GroupCounts{ { "cells copper", 1 }, { "cells 7", 1 },
                                 { "facets heated side", 1 }, { "facets 3", 1 } }));
  EXPECT_EQ(elementColumn(mesh, "Reference").value(3), 7);
  writeBytes(this->Folder / "mesh", NetgenMesh);
  EXPECT_EQ(formatOfFile(this->Folder / "mesh"), &NetgenFormat);
}

TEST_F(ImportNetgen, PlaneMeshesHaveEdges)
{
  const ReadMesh mesh = this->netgen(
    "mesh3d\ndimension\n2\ngeomtype\n0\nsurfaceelementsuv\n1\n1 4 0 0 6 1 2 3 3 1 2 0 0 0 1 1 0\n"
    "edgesegmentsgi2\n2\n5 0 1 2 -1 -1 0 0 1 0 1 1\n6 0 2 3 -1 -1 0 0 1 0 1 1\n"
    "points\n3\n0 0 0\n1 0 0\n0 1 0\nmaterials\n1\n4 air\nbcnames\n1\n5 wall\nendmesh\n");
  EXPECT_EQ(mesh.counts.higherOrderCells, 1);
  EXPECT_EQ(groupCounts(mesh),
    (GroupCounts{ { "cells air", 1 }, { "facets wall", 1 }, { "facets 6", 1 } }));
}

TEST_F(ImportNetgen, SolidsAreNotTurnedOver)
{
  // Netgen's order of the corners of each solid.
  const std::vector<std::vector<std::size_t>> orders{ { 0, 3, 2, 1, 4, 7, 6, 5 }, { 0, 3, 2, 1, 4 },
    { 0, 2, 1, 3, 5, 4 }, { 0, 2, 1, 3 } };
  std::string text = "mesh3d\ndimension\n3\nvolumeelements\n4\n";
  for (std::size_t i = 0; i < 4; ++i)
  {
    text += "1 " + std::to_string(FourSolids[i].size());
    for (const std::size_t k : orders[i])
    {
      text += ' ' + std::to_string(FourSolids[i][k] + 1);
    }
    text += '\n';
  }
  text += "points\n12\n";
  for (const auto& point : FourSolidsPoints)
  {
    text += exact(point[0]) + ' ' + exact(point[1]) + ' ' + exact(point[2]) + '\n';
  }
  expectFourSolids(this->netgen(text + "endmesh\n"));
}

TEST_F(ImportNetgen, ErrorsNameTheLine)
{
  const auto expectRefused = [this](const std::string& text, const std::string& part)
  { expectError([&] { this->netgen(text); }, part); };
  expectRefused(replacedFirst(NetgenMesh, "1 4 1 3 2 4", "1 7 1 3 2 4"), "line 16: elements of 7");
  expectRefused(replacedFirst(NetgenMesh, "1 4 1 3 2 4", "1 4 1 3 2 9"), "line 16: the corner 9");
  expectRefused(replacedFirst(NetgenMesh, "1 1 1", "1 x 1"), "a.vol, line 29");
  expectRefused(replacedFirst(NetgenMesh, "points\n5", "points\n999999"), "line 24");
  expectRefused("mesh3d\ndimension\n4\n", "the dimension must be 2 or 3");
}

TEST_F(ImportNetgen, DamagedFilesAreRefusedOrValid)
{
  this->expectSafe(NetgenFormat, "a.vol", NetgenMesh);
}

} // namespace smg::testing
