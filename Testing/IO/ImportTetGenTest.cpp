// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/VolumeImport.h"

namespace smg::testing
{
namespace
{

const std::string Nodes = "# made by hand\n5 3 2 1\n0 0 0 0 0.5 -1 7\n1 1 0 0 1.5 -2 8\n"
                          "2 0 1 0 2.5 -3 0 # the third\n\n3 0 0 1 3.5 -4 0\n4 1 1 1 4.5 -5 9\n";
const std::string Elements = "2 4 1\n0 0 1 2 3 10\n1 1 2 3 4 -20\n# Generated\n";
const std::string PlainNodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";

class ImportTetGen : public VolumeImport
{
protected:
  ReadMesh tetGen(const std::string& nodes, const std::string& elements)
  {
    this->write("a.1.node", nodes);
    return this->read(TetGenFormat, "a.1.ele", elements);
  }
  void expectRefused(const std::string& nodes, const std::string& elements, const std::string& part)
  {
    expectError([&] { this->tetGen(nodes, elements); }, part);
  }
};

} // namespace

TEST_F(ImportTetGen, EitherFileIsOpened)
{
  const ReadMesh mesh = this->tetGen(Nodes, Elements);
  EXPECT_EQ(mesh.vertices(), 5);
  EXPECT_EQ(mesh.positions[3 * 4 + 2], 1.0);
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(this->readFile(TetGenFormat, this->Folder / "a.1.node").corners, mesh.corners);
}

TEST_F(ImportTetGen, AttributesAndMarkersAreColumns)
{
  const ReadMesh mesh = this->tetGen(Nodes, Elements);
  ASSERT_EQ(mesh.vertexColumns.size(), 2u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, (ColumnSpec{ "Attribute", ScalarType::Float64, 2 }));
  EXPECT_EQ(mesh.vertexColumns[0].value(3, 0), 3.5);
  EXPECT_EQ(mesh.vertexColumns[0].value(3, 1), -4);
  EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "Marker", ScalarType::Int64, 1 }));
  EXPECT_EQ(mesh.vertexColumns[1].value(4), 9);
  const Column& attributes = elementColumn(mesh, "Attribute");
  EXPECT_EQ(attributes.spec, (ColumnSpec{ "Attribute", ScalarType::Float64, 1 }));
  EXPECT_EQ(attributes.value(1), -20);
}

TEST_F(ImportTetGen, MarkersAndRegionsAreGroups)
{
  const GroupCounts own{ { "cells 10", 1 }, { "cells -20", 1 }, { "vertices 7", 1 },
    { "vertices 8", 1 }, { "vertices 9", 1 } };
  EXPECT_EQ(groupCounts(this->tetGen(Nodes, Elements)), own);
  // Real attributes are measures.
  EXPECT_EQ(groupCounts(this->tetGen(PlainNodes, "1 4 1\n1 1 2 3 4 0.5\n")).count("cells 0"), 0u);
  this->write("a.1.face", "3 1\n0 0 1 2 5\n1 1 2 3 0 0 1\n2 4 3 2 -6 1 -1\n");
  this->write("a.1.edge", "1 1\n0 3 4 2\n");
  GroupCounts all = own;
  all.insert({ { "facets 5", 1 }, { "facets -6", 1 }, { "vertices 2", 2 } });
  EXPECT_EQ(groupCounts(this->tetGen(Nodes, Elements)), all);
  this->write("a.1.face", "1 1\n0 0 1 7 5\n");
  this->expectRefused(Nodes, Elements, "a.1.face, line 2: the corner 7");
  this->write("a.1.face", "1 1\n0 0 1 2\n");
  this->expectRefused(Nodes, Elements, "a.1.face, line");
}

TEST_F(ImportTetGen, NumbersCountFromZeroOrOne)
{
  const std::vector<std::int64_t> corners{ 0, 1, 2, 3 };
  EXPECT_EQ(this->tetGen(PlainNodes, "1 4 0\n1 1 2 3 4\n").corners, corners);
  EXPECT_EQ(
    this->tetGen("4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n", "1 4\n0 0 1 2 3\n").corners, corners);
}

TEST_F(ImportTetGen, OnlyCornersOfHigherOrderElementsAreUsed)
{
  const ReadMesh mesh = this->tetGen(PlainNodes, "1 10 0\n1 1 2 3 4 1 1 1 1 1 1\n");
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3 }));
  EXPECT_EQ(mesh.counts.higherOrderCells, 1);
}

TEST_F(ImportTetGen, PlaneMeshesOfTriangles)
{
  const ReadMesh mesh = this->tetGen("3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n", "1 3 0\n1 1 2 3\n");
  EXPECT_EQ(mesh.cellType, CellType::Triangle);
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
}

TEST_F(ImportTetGen, TheOtherFileMustBeThere)
{
  this->write("b.node", PlainNodes);
  expectError([&] { this->readFile(TetGenFormat, this->Folder / "b.node"); }, "b.ele', which has");
  this->write("c.ele", Elements);
  expectError([&] { this->readFile(TetGenFormat, this->Folder / "c.ele"); }, "c.node', which has");
}

TEST_F(ImportTetGen, ErrorsNameFileAndLine)
{
  const std::string one = "1 4 0\n1 1 2 3 4\n";
  this->expectRefused(
    PlainNodes, "1 4 0\n1 1 2 3 5\n", "a.1.ele, line 2: the corner 5 is not a vertex");
  this->expectRefused(
    PlainNodes, "1 4 0\n1 0 2 3 4\n", "a.1.ele, line 2: the corner 0 is not a vertex");
  this->expectRefused(
    PlainNodes, "1 4 0\n1 -1 2 3 4\n", "a.1.ele, line 2: the corner -1 is not a vertex");
  this->expectRefused(PlainNodes, "1 4 0\n2 1 2 3 4\n", "line 2: an element has the number 2");
  this->expectRefused(PlainNodes, "1 5 0\n1 1 2 3 4 1\n", "elements of 5 nodes");
  this->expectRefused(PlainNodes, "2 4 0\n1 1 2 3 4\n2 1 2 3", "line 3");
  this->expectRefused(PlainNodes, "1 4 0\n1 1 2 3 4\n2 1 2 3 4", "line 3: '2' stands after");
  this->expectRefused(PlainNodes, "9999999999 4 0\n1 1 2 3 4\n", "truncated");
  this->expectRefused(PlainNodes, "1 4 99999999\n1 1 2 3 4\n", "number of attributes");
  this->expectRefused(PlainNodes, "0 4 0\n", "no triangles and no tetrahedra");
  this->expectRefused("4 3 0 0\n1 0 0 0\n2 1 0 0\n4 0 1 0\n", one, "a.1.node, line 4: a node has");
  this->expectRefused("4 3 0 0\n1 0 0 nan\n2 1 0 0\n3 0 1 0\n4 0 0 1\n", one, "a.1.node, line 2");
  this->expectRefused("4 4 0 0\n1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n", one, "the dimension");
  this->expectRefused("4 3 0 2\n1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n", one, "boundary markers");
}

TEST_F(ImportTetGen, DamagedFilesAreRefusedOrValid)
{
  this->write("d.node", Nodes);
  this->expectSafe(TetGenFormat, "d.ele", Elements);
  this->write("d.ele", Elements);
  this->expectSafe(TetGenFormat, "d.node", Nodes);
}

} // namespace smg::testing
