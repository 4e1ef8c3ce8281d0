// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/WriteFiles.h"
#include "Testing/IO/ImportFixture.h"
#include "smg/Convert.h"
#include "smg/WriteMesh.h"

#include <cmath>
#include <string>
#include <vector>

// $NodeData and $ElementData of Gmsh as columns, and back.

namespace smg::testing
{
namespace
{

const std::string Tetrahedra =
  "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 1\n$EndNodes\n"
  "$Elements\n3\n7 2 2 3 1 10 20 30\n9 4 2 1 1 10 20 30 40\n"
  "8 4 2 1 1 20 30 40 50\n$EndElements\n";

std::string meshWith(const std::string& data)
{
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + Tetrahedra + data;
}

std::string section(const std::string& kind, const std::string& name, int step, int components,
  const std::vector<std::string>& lines)
{
  std::string text = '$' + kind + "\n1\n\"" + name + "\"\n1\n0.5\n3\n" + std::to_string(step) +
                     '\n' + std::to_string(components) + '\n' + std::to_string(lines.size()) + '\n';
  for (const std::string& line : lines)
  {
    text += line + '\n';
  }
  return text + "$End" + kind + '\n';
}

std::vector<double> valuesOf(const std::vector<Column>& columns, const std::string& name)
{
  for (const Column& column : columns)
  {
    if (column.spec.name == name)
    {
      const auto values = column.as<double>();
      return { values.begin(), values.end() };
    }
  }
  return {};
}

class GmshData : public ImportFixture
{
};

} // namespace

TEST_F(GmshData, IsAColumnByTheNumbersOfNodesAndElements)
{
  const ReadMesh mesh = this->read("a.msh",
    meshWith(section("NodeData", "T in K", 0, 1, { "40 4", "10 1", "50 5", "20 2", "99 9" }) +
             section("ElementData", "flux", 0, 3, { "8 4 5 6", "9 1 2 3" }) +
             section("ElementData", "of facets", 0, 1, { "7 1" })));
  std::vector<double> t = valuesOf(mesh.vertexColumns, "T in K");
  ASSERT_EQ(t.size(), 5U);
  EXPECT_TRUE(std::isnan(t[2]));
  t[2] = 3;
  EXPECT_EQ(t, (std::vector<double>{ 1, 2, 3, 4, 5 }));
  const std::vector<double> flux = valuesOf(mesh.elementColumns, "flux");
  ASSERT_EQ(flux.size(), 9U);
  EXPECT_TRUE(std::isnan(flux[0]));
  EXPECT_EQ(
    std::vector<double>(flux.begin() + 3, flux.end()), (std::vector<double>{ 1, 2, 3, 4, 5, 6 }));
  EXPECT_TRUE(valuesOf(mesh.elementColumns, "of facets").empty());
}

TEST_F(GmshData, OfTheLastTimeStepIsRead)
{
  const ReadMesh mesh = this->read(
    "a.msh", meshWith(section("NodeData", "T", 0, 1, { "10 1", "20 1", "30 1", "40 1", "50 1" }) +
                      section("NodeData", "T", 1, 1, { "10 2", "20 2", "30 2" }) +
                      section("NodeData", "T", 1, 1, { "40 2", "50 2" })));
  EXPECT_EQ(valuesOf(mesh.vertexColumns, "T"), std::vector<double>(5, 2.0));
}

TEST_F(GmshData, ComesBack)
{
  writeBytes(this->Folder / "in.msh",
    meshWith(section("NodeData", "T", 0, 1, { "40 4.25", "10 1", "50 5e-300", "20 2" }) +
             section("ElementData", "stress", 0, 9, { "8 1 2 3 4 5 6 7 8 9" }) +
             section("ElementData", "flux", 0, 3, { "8 4 5 6", "9 1 2 3" })));
  convert(this->Folder / "in.msh", this->Folder / "mesh.vsm");
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  writeRestored(this->Folder / "mesh.vsm", this->Folder / "out.msh", workspace, false);
  const ReadMesh before = this->readFile(this->Folder / "in.msh");
  const ReadMesh after = this->readFile(this->Folder / "out.msh");
  const auto equal = [](const std::vector<double>& a, const std::vector<double>& b)
  {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(),
             [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
  };
  EXPECT_TRUE(equal(valuesOf(before.vertexColumns, "T"), valuesOf(after.vertexColumns, "T")));
  for (const char* name : { "stress", "flux" })
  {
    const std::vector<double> a = valuesOf(before.elementColumns, name);
    const std::vector<double> b = valuesOf(after.elementColumns, name);
    // The cells come first in the file that is written, after the facet in that which was read.
    const std::size_t components = a.size() / 3;
    ASSERT_EQ(b.size(), a.size());
    EXPECT_TRUE(equal({ a.begin() + std::ptrdiff_t(components), a.end() },
      { b.begin(), b.end() - std::ptrdiff_t(components) }));
  }
}

TEST_F(GmshData, RefusesWhatIsNone)
{
  testing::expectError(
    [&] { this->read("a.msh", meshWith("$NodeData\n1\nT\n")); }, "quotation marks");
  testing::expectError([&] { this->read("a.msh", meshWith(section("NodeData", "T", 0, 0, {}))); },
    "number of components, from 1 to");
  testing::expectError(
    [&] {
      this->read("a.msh", meshWith(section("NodeData", "T", 0, 1, { "10 1", "x" })));
    },
    "the tag of a node");
  testing::expectError(
    [&]
    {
      this->read(
        "a.msh", meshWith("$NodeData\n1\n\"T\"\n0\n3\n0\n1\n99999999\n1 2\n$EndNodeData\n"));
    },
    "cannot be the number of values");
}

TEST_F(GmshData, ACellThatIsListedForTwoGroupsIsInBoth)
{
  const std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 "
                           "1 0\n4 0 0 1\n$EndNodes\n"
                           "$Elements\n4\n1 4 2 5 1 1 2 3 4\n2 4 2 6 1 1 2 3 4\n3 2 2 7 1 1 2 3\n4 "
                           "2 2 8 1 1 2 3\n$EndElements\n";
  const ReadMesh mesh = this->read("a.msh", text);
  EXPECT_EQ(mesh.cells(), 1);
  EXPECT_EQ(groupCounts(mesh),
    (GroupCounts{ { "cells 5", 1 }, { "cells 6", 1 }, { "facets 7", 1 }, { "facets 8", 1 } }));
}

} // namespace smg::testing
