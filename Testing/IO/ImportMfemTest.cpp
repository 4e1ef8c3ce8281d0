// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/VolumeImport.h"

#include <string>

namespace smg::testing
{
namespace
{

const std::string MfemElements = "dimension\n3\n\nelements\n2\n1 4 0 1 2 3\n4 4 1 2 3 4\n\n"
                                 "boundary\n2\n7 2 0 1 2\n8 2 0 1 3\n\n";
const std::string MfemVertices = "vertices\n5\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
const std::string MfemMesh = "MFEM mesh v1.0\n# geometry types\n\n" + MfemElements + MfemVertices;

class ImportMfem : public VolumeImport
{
protected:
  ReadMesh mfem(const std::string& text) { return this->read(MfemFormat, "a.mesh", text); }
};

const GroupCounts OfMfem{ { "cells 1", 1 }, { "cells 4", 1 }, { "facets 7", 1 },
  { "facets 8", 1 } };

} // namespace

TEST_F(ImportMfem, AttributesAreGroups)
{
  const ReadMesh mesh = this->mfem(MfemMesh);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(mesh.elementCount, 2);
  EXPECT_EQ(groupCounts(mesh), OfMfem);
  EXPECT_EQ(elementColumn(mesh, "Reference").value(1), 4);
  EXPECT_EQ(formatOfFile(this->Folder / "a.mesh"), &MfemFormat);
}

TEST_F(ImportMfem, SetsOfAttributesHaveNames)
{
  const ReadMesh mesh = this->mfem("MFEM mesh v1.3\n\n" + MfemElements +
                                   "attribute_sets\n2\n\"Base\" 1 4\n\"Top part\" 4\n\n"
                                   "bdr_attribute_sets\n1\n\"Sides\" 8 7\n\n" +
                                   MfemVertices + "mfem_mesh_end\n");
  GroupCounts expected = OfMfem;
  expected.insert({ { "cells Base", 2 }, { "cells Top part", 1 }, { "facets Sides", 2 } });
  EXPECT_EQ(groupCounts(mesh), expected);
}

TEST_F(ImportMfem, CurvedMeshesHaveNodes)
{
  const ReadMesh straight = this->mfem(MfemMesh);
  const std::string head = "MFEM mesh v1.0\n" + MfemElements +
                           "vertices\n5\n\nnodes\nFiniteElementSpace\n"
                           "FiniteElementCollection: H1_3D_P2\nVDim: 3\nOrdering: ";
  const ReadMesh byNode =
    this->mfem(head + "1\n\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n.5 .5 .5\n.1 .2 .3\n");
  EXPECT_EQ(byNode.positions, straight.positions);
  const ReadMesh byAxis =
    this->mfem(head + "0\n0\n1\n0\n0\n1\n.5\n.1\n0\n0\n1\n0\n1\n.5\n.2\n0\n0\n0\n1\n1\n.5\n.3\n");
  EXPECT_EQ(byAxis.positions, straight.positions);
  EXPECT_EQ(byAxis.counts.notes.size(), 1u);
  std::string apart = head + "1\n";
  apart.replace(apart.find("H1"), 2, "L2");
  expectError([&] { this->mfem(apart); }, "'L2_3D_P2', which is not continuous");
}

TEST_F(ImportMfem, SolidsBecomeTetrahedra)
{
  std::string text = "MFEM mesh v1.0\ndimension\n3\nelements\n4\n";
  constexpr int types[] = { 5, 7, 6, 4 };
  for (std::size_t i = 0; i < 4; ++i)
  {
    text += "1 " + std::to_string(types[i]);
    for (const std::int64_t corner : FourSolids[i])
    {
      text += ' ' + std::to_string(corner);
    }
    text += '\n';
  }
  text += "boundary\n0\nvertices\n12\n3\n";
  for (const auto& point : FourSolidsPoints)
  {
    text += exact(point[0]) + ' ' + exact(point[1]) + ' ' + exact(point[2]) + '\n';
  }
  expectFourSolids(this->mfem(text));
}

TEST_F(ImportMfem, PlaneMeshes)
{
  const ReadMesh mesh =
    this->mfem("MFEM mesh v1.0\ndimension\n2\nelements\n2\n1 3 0 1 2 3\n"
               "2 2 1 4 2\nboundary\n1\n5 1 0 1\nvertices\n5\n2\n0 0\n1 0\n1 1\n"
               "0 1\n2 0\n");
  EXPECT_EQ(mesh.cells(), 3);
  EXPECT_EQ(
    groupCounts(mesh), (GroupCounts{ { "cells 1", 1 }, { "cells 2", 1 }, { "facets 5", 1 } }));
}

TEST_F(ImportMfem, ErrorsNameTheLine)
{
  const auto expectRefused = [this](const std::string& text, const std::string& part)
  { expectError([&] { this->mfem("MFEM mesh v1.0\n" + text); }, part); };
  expectRefused("dimension\n1\n", "a.mesh, line 3: the dimension must be 2 or 3");
  expectRefused("dimension\n3\nelements\n1\n1 9 0 1 2 3\n", "line 6: the geometry 9");
  expectRefused("elements\n1\n1 4 0 1 2 5\nvertices\n5\n3\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1",
    "line 4: the corner 5");
  expectRefused("vertex_parents\n1\n", "line 2: the section 'vertex_parents' is not read");
  expectRefused("elements\n99999999\n1 4", "line 3");
}

TEST_F(ImportMfem, DamagedFilesAreRefusedOrValid)
{
  this->expectSafe(MfemFormat, "a.mesh", MfemMesh);
  this->expectSafe(MfemFormat, "a.mesh",
    "MFEM mesh v1.3\n" + MfemElements +
      "attribute_sets\n1\n\"Base\" 1 4\nvertices\n5\nnodes\n"
      "FiniteElementSpace\nFiniteElementCollection: H1_3D_P1\nVDim: 3\nOrdering: 0\n"
      "0 1 0 0 1 0 0 1 0 1 0 0 0 1 1\n");
}

} // namespace smg::testing
