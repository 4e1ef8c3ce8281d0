// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/VolumeImport.h"

#include <set>
#include <string>

namespace smg::testing
{
namespace
{

/** Two tetrahedra and a triangle of their boundary, with labels that neither begin with 1 nor
 * ascend. */
const std::string AbaqusNodes =
  "** made by hand\n*Heading\n a mesh\n*NODE, nset=all\n"
  "10, 0, 0, 0\n20, 1.0D0, 0,\n40, 0, 0, 1\n30, 0., 1.\n50, 1, 1, 1\n";
const std::string AbaqusElements = AbaqusNodes +
                                   "*Element, type=c3d4, elset=\"Left Part\"\n7, 10,20, 30,\n40\n"
                                   "*ELEMENT,TYPE = C3D4,\nELSET=right\n5, 20, 30, 40, 50\n"
                                   "*ELEMENT, TYPE=S3, ELSET=skin\n9, 10, 20, 30\n";

class ImportAbaqus : public VolumeImport
{
protected:
  ReadMesh abaqus(const std::string& text, CellChoice choice = CellChoice::Only)
  {
    return this->read(AbaqusFormat, "a.inp", text, choice);
  }
  void expectRefused(const std::string& text, const std::string& part)
  {
    expectError([&] { this->abaqus(text); }, part);
  }
};

const GroupCounts AbaqusBlocks{ { "cells Left Part", 1 }, { "cells right", 1 },
  { "facets skin", 1 }, { "vertices all", 5 } };

GroupCounts joined(GroupCounts members, const GroupCounts& more)
{
  members.insert(more.begin(), more.end());
  return members;
}

} // namespace

TEST_F(ImportAbaqus, LabelsAreAny)
{
  const ReadMesh mesh = this->abaqus(AbaqusElements);
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1 }));
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 3, 2, 1, 3, 2, 4 }));
  EXPECT_EQ(mesh.facets, (std::vector<std::int64_t>{ 0, 1, 3 }));
  EXPECT_EQ(groupCounts(mesh), AbaqusBlocks);
  EXPECT_EQ(this->abaqus(AbaqusElements, CellChoice::Triangles).cells(), 1);
}

TEST_F(ImportAbaqus, SetsAreGroups)
{
  const std::string sets = "*NSET, NSET=some\n10, 20,\n99\n*NSET, NSET=more, GENERATE\n20, 60, 10\n"
                           "*NSET, NSET=both\nsome, MORE\n*ELSET, ELSET=each, GENERATE\n5, 9, 2\n"
                           "*ELSET, ELSET=hidden, INTERNAL\n5\n*ELSET, ELSET=parts\nhidden, 7\n"
                           "*SURFACE, NAME=outside, TYPE=ELEMENT\nLEFT PART, S1\n5, S3\n"
                           "*SURFACE, NAME=inside\nright, S1\nskin, SPOS\n"
                           "*SURFACE, NAME=points, TYPE=NODE\nmore, 1.5\n10,\n";
  const ReadMesh mesh = this->abaqus(AbaqusElements + sets);
  EXPECT_EQ(groupCounts(mesh),
    joined(
      AbaqusBlocks, { { "vertices some", 2 }, { "vertices more", 4 }, { "vertices both", 6 },
                      { "cells each", 2 }, { "facets each", 1 }, { "cells parts", 2 },
                      { "facets outside", 2 }, { "facets inside", 2 }, { "vertices points", 5 } }));
  EXPECT_EQ(mesh.counts.notes.size(), 1u);
  EXPECT_NE(mesh.counts.notes.at(0).find("1 entry of sets and surfaces"), std::string::npos);
}

TEST_F(ImportAbaqus, SidesAreThoseOfTheManual)
{
  // The sides of a tetrahedron: 1-2-3, 1-4-2, 2-4-3, 3-4-1.
  const std::string sides = "*SURFACE, NAME=s1\n7, S1\n*SURFACE, NAME=s2\n7, S2\n"
                            "*SURFACE, NAME=s3\n7, S3\n*SURFACE, NAME=s4\n7, S4\n";
  const ReadMesh mesh = this->abaqus(AbaqusElements + sides);
  ASSERT_EQ(mesh.facets.size(), 15u);
  std::vector<std::set<std::int64_t>> facets;
  for (std::size_t i = 3; i < mesh.facets.size(); i += 3)
  {
    facets.push_back({ mesh.facets[i], mesh.facets[i + 1], mesh.facets[i + 2] });
  }
  EXPECT_EQ(facets,
    (std::vector<std::set<std::int64_t>>{ { 0, 1, 3 }, { 0, 2, 1 }, { 1, 2, 3 }, { 3, 2, 0 } }));
  // Edges of shells have numbers of their own in Abaqus, and follow the faces in CalculiX.
  const std::string edges = "*SURFACE, NAME=a\n9, E2\n*SURFACE, NAME=c\n9, S4\n";
  const ReadMesh shell = this->abaqus(AbaqusElements + edges, CellChoice::Triangles);
  EXPECT_EQ(shell.facets, (std::vector<std::int64_t>{ 1, 3, 1, 3 }));
}

TEST_F(ImportAbaqus, SolidsAndHigherOrders)
{
  std::string text = "*NODE\n";
  int label = 0;
  for (const auto& point : FourSolidsPoints)
  {
    text += std::to_string(++label) + ", " + exact(point[0]) + ", " + exact(point[1]) + ", " +
            exact(point[2]) + '\n';
  }
  constexpr const char* types[] = { "C3D8R", "C3D5", "C3D6", "DC3D4" };
  for (std::size_t i = 0; i < 4; ++i)
  {
    text += std::string("*ELEMENT, TYPE=") + types[i] + '\n' + std::to_string(i + 1);
    for (const std::int64_t corner : FourSolids[i])
    {
      text += ", " + std::to_string(corner + 1);
    }
    text += '\n';
  }
  expectFourSolids(this->abaqus(text));
  const ReadMesh quadratic = this->abaqus(
    AbaqusNodes + "*ELEMENT, TYPE=C3D10M\n1, 10, 20, 30, 40,\n50, 50, 50, 50, 50, 50\n");
  EXPECT_EQ(quadratic.cells(), 1);
  EXPECT_EQ(quadratic.counts.higherOrderCells, 1);
  const ReadMesh masses = this->abaqus(AbaqusElements + "*ELEMENT, TYPE=MASS\n100, 10\n");
  EXPECT_EQ(masses.counts.notes,
    (std::vector<std::string>{ "Elements of these types are left out: 'MASS'." }));
}

TEST_F(ImportAbaqus, OnePartIsRead)
{
  const std::string part = "*PART, NAME=p\n" + AbaqusElements +
                           "*END PART\n*ASSEMBLY, NAME=a\n"
                           "*INSTANCE, NAME=p-1, PART=p\n*END INSTANCE\n"
                           "*NSET, NSET=held, INSTANCE=p-1\n10, 20\n*SURFACE, NAME=s\n"
                           "p-1.right, S1\n*END ASSEMBLY\n*STEP\n*STATIC\n1., 1.\n*END STEP\n";
  EXPECT_EQ(groupCounts(this->abaqus(part)),
    joined(AbaqusBlocks, { { "vertices held", 2 }, { "facets s", 1 } }));
  this->expectRefused(part + "*INSTANCE, NAME=p-2, PART=p\n*END INSTANCE\n", "several parts");
  this->expectRefused(
    "*PART, NAME=p\n" + AbaqusElements + "*INSTANCE, NAME=i, PART=p\n1., 0., 0.\n",
    "one that is moved");
}

TEST_F(ImportAbaqus, ErrorsNameTheLine)
{
  this->expectRefused("*NODE\n1, 0, x\n", "a.inp, line 2: 'x' stands where a coordinate");
  this->expectRefused("*NODE\n1, 0, 1e999\n", "a.inp, line 2");
  this->expectRefused("*NODE\n0, 0, 0\n", "line 2: the number 0 is not one of nodes");
  this->expectRefused(AbaqusNodes + "10, 0, 0\n", "there are two nodes 10");
  this->expectRefused(AbaqusElements + "9, 10, 20, 30\n", "there are two elements 9");
  this->expectRefused(AbaqusElements + "11, 10, 20\n", "line 18: the lines end where");
  this->expectRefused(AbaqusElements + "*ELSET, ELSET=e\nnone\n", "line 19: 'none' is neither");
  this->expectRefused(AbaqusElements + "*SURFACE, NAME=s\n7, S9\n", "line 19: 'S9' of the surface");
  this->expectRefused(AbaqusElements + "*INCLUDE, INPUT=other.inp\n", "line 18: another file");
  this->expectRefused(AbaqusElements + "*ELGEN\n1, 2\n", "line 18: *ELGEN makes");
  this->expectRefused(AbaqusElements + "*ELSET, ELSET=e, GENERATE\n1, 5, 0\n", "the range cannot");
  this->expectRefused("*NODE\n1, 0, 0\n", "no triangles and no tetrahedra");
}

TEST_F(ImportAbaqus, ItIsKnownByItsContent)
{
  writeBytes(this->Folder / "mesh", AbaqusElements);
  EXPECT_EQ(formatOfFile(this->Folder / "mesh"), &AbaqusFormat);
}

TEST_F(ImportAbaqus, DamagedFilesAreRefusedOrValid)
{
  this->expectSafe(AbaqusFormat, "a.inp",
    AbaqusElements + "*NSET, NSET=n, GENERATE\n10, 30\n*ELSET, ELSET=e\nskin, 5\n"
                     "*SURFACE, NAME=s\ne, S1\n5, S2\n");
}

} // namespace smg::testing
