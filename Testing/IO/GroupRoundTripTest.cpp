// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "IO/Formats/WriteFiles.h"
#include "Testing/IO/ImportFixture.h"
#include "smg/Convert.h"
#include "smg/Describe.h"
#include "smg/VsmReader.h"
#include "smg/WriteMesh.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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

/** A surface of a quadrilateral and two triangles, with edges on either half of the quadrilateral,
 * one inside of the surface, and a triangle in two groups of edges. */
const std::string MixedSurface =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n0 1 \"tip\"\n1 1 \"bottom\"\n"
  "1 2 \"left\"\n1 3 \"middle\"\n2 1 \"square\"\n2 2 \"wing\"\n$EndPhysicalNames\n"
  "$Nodes\n6\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 5 0 0\n6 5 1 0\n$EndNodes\n"
  "$Elements\n11\n1 3 2 1 1 1 2 3 4\n2 2 2 2 2 2 5 3\n3 2 2 2 2 5 6 3\n4 1 2 1 1 1 2\n"
  "5 1 2 1 1 2 5\n6 1 2 2 2 4 1\n7 1 2 2 2 3 4\n8 1 2 3 3 2 3\n9 1 2 2 2 2 5\n"
  "10 15 2 1 1 6\n11 15 2 1 1 1\n$EndElements\n";
/** Three tetrahedra, whose faces in groups are on the boundary and between them; a point and an
 * edge with the same number, which are both groups of vertices. */
const std::string MixedSolid =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n0 1 \"tip\"\n1 1 \"rim\"\n2 1 "
  "\"inlet\"\n"
  "2 2 \"between\"\n3 1 \"copper\"\n3 2 \"air\"\n$EndPhysicalNames\n"
  "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n6 2 1 2\n$EndNodes\n"
  "$Elements\n10\n1 4 2 1 1 1 2 3 4\n2 4 2 2 2 2 3 4 5\n3 4 2 2 2 2 4 5 6\n4 2 2 1 1 1 2 3\n"
  "5 2 2 1 1 1 2 4\n6 2 2 2 2 2 3 4\n7 2 2 1 1 2 3 4\n8 2 2 2 2 4 5 6\n9 15 2 1 1 6\n"
  "10 1 2 1 1 1 2\n$EndElements\n";

/** Size and, with names, label and kind of each group, in order. */
using GroupSizes = std::vector<std::string>;

GroupSizes groupSizes(const std::filesystem::path& vsm, bool withNames)
{
  const VsmReader reader(vsm);
  GroupSizes sizes;
  for (const MeshDescription::Group& group : describe(reader).groups)
  {
    if (group.count > 0)
    {
      constexpr const char* kinds[] = { "vertices", "facets", "cells" };
      const double rounded = std::round(group.measure * 1e9) / 1e9;
      sizes.push_back(std::string(kinds[std::size_t(group.group.of)]) + ' ' +
                      (withNames ? group.group.name : "") + ' ' + std::to_string(group.count) +
                      ' ' + std::to_string(rounded));
    }
  }
  std::ranges::sort(sizes);
  return sizes;
}

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

/** All formats that hold groups: written in either order and read again, groups have the same names
 * where the format has these, members and sizes. */
TEST_F(GroupRoundTrip, OfEveryFormatKeepsNamesCountsAndSizes)
{
  for (const std::string* text : { &MixedSurface, &MixedSolid })
  {
    const CellType cells = text == &MixedSolid ? CellType::Tetrahedron : CellType::Triangle;
    writeBytes(this->Folder / "in.msh", *text);
    convert(this->Folder / "in.msh", this->Folder / "mesh.vsm");
    int held = 0;
    for (const Format* format : formats())
    {
      const bool hasNames = format != &MeditFormat && format != &TetGenFormat;
      for (const FileSuffix& suffix : format->suffixes)
      {
        if (format->groups == GroupForm::None || !suffix.holds(cells) ||
            !suffixFor(FormatUse::Write, "a" + std::string(suffix.text)))
        {
          continue;
        }
        const GroupSizes expected = groupSizes(this->Folder / "mesh.vsm", hasNames);
        ++held;
        for (const char* order : { "stream", "text", "restored" })
        {
          const bool isText = std::string(order) == "text";
          const std::filesystem::path path =
            this->Folder /
            (std::string(order) + std::to_string(cornersOf(cells)) + std::string(suffix.text));
          SCOPED_TRACE(path.filename());
          if (isText && suffix.form != FileForm::Either)
          {
            continue;
          }
          if (std::string(order) != "restored")
          {
            writeFromVsm(this->Folder / "mesh.vsm", path, {}, {}, isText);
          }
          else if (suffixFor(FormatUse::Restore, path))
          {
            Workspace workspace(this->Folder.path(), Workspace::MinMemory);
            writeRestored(this->Folder / "mesh.vsm", path, workspace, false);
          }
          else
          {
            continue;
          }
          convert(path, this->Folder / "again.vsm");
          EXPECT_EQ(groupSizes(this->Folder / "again.vsm", hasNames), expected);
        }
      }
    }
    EXPECT_GE(held, 7);
  }
}

/** Edges of polygons that become triangles, and diagonals, which only some formats have a place
 * for. */
TEST_F(GroupRoundTrip, DiagonalsOfQuadrilateralsAreNoted)
{
  std::string text = MixedSurface;
  text.replace(text.find("8 1 2 3 3 2 3\n"), 14, "8 1 2 3 3 1 3\n");
  writeBytes(this->Folder / "in.msh", text);
  convert(this->Folder / "in.msh", this->Folder / "mesh.vsm");
  const GroupSizes expected = groupSizes(this->Folder / "mesh.vsm", true);
  Workspace workspace(this->Folder.path(), Workspace::MinMemory);
  writeRestored(this->Folder / "mesh.vsm", this->Folder / "a.msh", workspace, false);
  convert(this->Folder / "a.msh", this->Folder / "again.vsm");
  EXPECT_EQ(groupSizes(this->Folder / "again.vsm", true), expected);
  const auto notes =
    writeRestored(this->Folder / "mesh.vsm", this->Folder / "a.inp", workspace, false);
  EXPECT_TRUE(std::ranges::any_of(
    notes, [](const std::string& note) { return note.find("diagonal") != std::string::npos; }));
}

/** A surface that was cut out of a solid has the arrays of its cells. */
TEST_F(GroupRoundTrip, FacetsOfASolidAreLeftOutOfItsSurface)
{
  writeBytes(this->Folder / "in.inp", AbaqusSurface);
  convert(this->Folder / "in.inp", this->Folder / "mesh.vsm");
  writeFromVsm(this->Folder / "mesh.vsm", this->Folder / "a.vtk", {}, {}, true);
  std::ifstream file(this->Folder / "a.vtk");
  std::string text{ std::istreambuf_iterator<char>(file), {} };
  const std::string ofFacets = "FacetGroups 3 2 ";
  ASSERT_NE(text.find(ofFacets), std::string::npos);
  text.replace(text.find(ofFacets), ofFacets.size(), "FacetGroups 4 2 ");
  text += "0 0\n";
  const ReadMesh mesh = this->read("b.vtk", text);
  EXPECT_EQ(groupCounts(mesh), (GroupCounts{ { "cells plate", 2 }, { "vertices held", 1 } }));
  ASSERT_EQ(mesh.counts.notes.size(), 1U);
  EXPECT_NE(mesh.counts.notes.front().find("'FacetGroups' is left out"), std::string::npos);
  convert(this->Folder / "b.vtk", this->Folder / "again.vsm");
  EXPECT_EQ(groupSizes(this->Folder / "again.vsm", true).size(), 2U);
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
