// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/GmshWriter.h"
#include "Testing/IO/VolumeImport.h"
#include "Testing/Support/ColumnValues.h"
#include "Testing/Support/TestFolders.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numeric>

namespace smg::testing
{
namespace
{

/** The four solids in a file of this kind, with these tags of the nodes. */
std::string fourSolids(GmshVariant variant, const Numbers& tags)
{
  GmshWriter writer(variant);
  writer.nodes(tags, FourSolidsPoints);
  std::vector<GmshElement> elements;
  constexpr int types[] = { 5, 7, 6, 4 };
  for (std::size_t i = 0; i < 4; ++i)
  {
    GmshElement element{ types[i], {} };
    for (const std::int64_t corner : FourSolids[i])
    {
      element.nodes.push_back(tags[static_cast<std::size_t>(corner)]);
    }
    elements.push_back(element);
  }
  writer.elements(elements);
  return writer.bytes();
}

Numbers consecutiveTags(std::int64_t first)
{
  Numbers tags(12);
  for (std::size_t k = 0; k < tags.size(); ++k)
  {
    tags[k] = first + static_cast<std::int64_t>(k);
  }
  return tags;
}

const std::string Format2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string Format4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string Nodes2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string Elements2 = "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";

class ImportGmsh : public VolumeImport
{
protected:
  ReadMesh gmsh(const std::string& bytes, CellChoice choice = CellChoice::Only)
  {
    return this->read(GmshFormat, "a.msh", bytes, choice);
  }
  void expectRefused(const std::string& bytes, const std::string& part)
  {
    expectError([&] { this->gmsh(bytes); }, part);
  }
};

} // namespace

TEST_F(ImportGmsh, AllVariantsAndShapes)
{
  for (const GmshVariant& variant : GmshVariants)
  {
    SCOPED_TRACE(std::to_string(variant.version) + (variant.binary ? " binary" : " text") +
                 (variant.swapped ? ", swapped" : ""));
    expectFourSolids(this->gmsh(fourSolids(variant, consecutiveTags(1))));
    expectFourSolids(this->gmsh(fourSolids(variant, consecutiveTags(77))));
  }
}

TEST_F(ImportGmsh, TagsInAnyOrderKeepTheOrderOfTheVertices)
{
  const Numbers tags{ 1, 2, 40, 3, 1000, 7, 5, 4, 900, 13, 12, 11 };
  for (const GmshVariant& variant : GmshVariants)
  {
    const ReadMesh mesh = this->gmsh(fourSolids(variant, tags));
    expectFourSolids(mesh);
    for (std::size_t i = 0; i < 12; ++i)
    {
      EXPECT_EQ(mesh.positions[3 * i + 2], FourSolidsPoints[i][2]);
    }
    EXPECT_EQ((Numbers{ mesh.corners.end() - 4, mesh.corners.end() }), FourSolids[3]);
  }
}

TEST_F(ImportGmsh, TagsFarApartTakeSeveralPasses)
{
  Numbers tags = consecutiveTags(1);
  tags[3] = 9000000;
  tags[8] = 5000000;
  expectFourSolids(this->gmsh(fourSolids(GmshVariants[1], tags)));
  tags[3] = 4294967290;
  expectFourSolids(this->gmsh(fourSolids(GmshVariants[1], tags)));
  // Only their range matters, not their size.
  for (std::int64_t& tag : tags)
  {
    tag += std::int64_t(1) << 40;
  }
  expectFourSolids(this->gmsh(fourSolids(GmshVariants[4], tags)));
  tags[8] += std::int64_t(1) << 32;
  this->expectRefused(fourSolids(GmshVariants[4], tags), "renumber the nodes");
}

TEST_F(ImportGmsh, TagsMayBeTheLargestThereAre)
{
  Numbers tags = consecutiveTags(std::numeric_limits<std::int64_t>::max() - 11);
  expectFourSolids(this->gmsh(fourSolids(GmshVariants[4], tags)));
  std::swap(tags.front(), tags.back());
  expectFourSolids(this->gmsh(fourSolids(GmshVariants[4], tags)));
}

TEST_F(ImportGmsh, TrianglesAndQuadrilaterals)
{
  const ReadMesh mesh = this->gmsh("$Comments\nby hand\n$EndComments\n" + Format2 +
                                   "$PhysicalNames\n1\n2 1 \"skin\"\n$EndPhysicalNames\n" + Nodes2 +
                                   "$Elements\n4\n1 1 2 0 1 1 2\n2 2 2 0 1 1 2 3\n3 3 0 1 2 3 4\n"
                                   "4 15 1 0 1\n$EndElements\n$Periodic\n1\n$EndPeriodic\n");
  EXPECT_EQ(mesh.cellType, CellType::Triangle);
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 0, 1, 2, 0, 2, 3 }));
  EXPECT_EQ(mesh.elements, (Numbers{ 1, 2, 2 }));
  EXPECT_EQ(mesh.counts.droppedCells, 2);
}

TEST_F(ImportGmsh, TagsOfElementsAreColumns)
{
  const ReadMesh mesh = this->gmsh(Format2 + Nodes2 +
                                   "$Elements\n3\n1 2 2 5 1 1 2 3\n2 2 3 6 8 9 2 3 4\n"
                                   "3 2 0 1 2 4\n$EndElements\n");
  ASSERT_EQ(mesh.elementColumns.size(), 3u); // and CellGroups
  EXPECT_EQ(mesh.elementColumns[0].spec, (ColumnSpec{ "PhysicalTag", ScalarType::Int64, 1 }));
  EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 5, 6, 0 }));
  EXPECT_EQ(mesh.elementColumns[1].spec, (ColumnSpec{ "GeometricalTag", ScalarType::Int64, 1 }));
  EXPECT_EQ(valuesOf(mesh.elementColumns[1]), (std::vector<double>{ 1, 8, 1 }));
  // Tags without information are not a column.
  EXPECT_TRUE(this->gmsh(Format2 + Nodes2 + Elements2).elementColumns.empty());
}

TEST_F(ImportGmsh, EntitiesTellThePhysicalGroups)
{
  for (const GmshVariant& variant : { GmshVariants[1], GmshVariants[4], GmshVariants[5] })
  {
    GmshWriter writer(variant);
    writer.text("$Entities\n");
    for (const std::int64_t count : { 1, 0, 1, 1 })
    {
      writer.size(count);
    }
    const auto entity = [&writer](std::int64_t tag, int bounds, const Numbers& groups, bool isPoint)
    {
      writer.integer(tag);
      for (int k = 0; k < bounds; ++k)
      {
        writer.real(0.5);
      }
      writer.size(std::int64_t(groups.size()));
      std::ranges::for_each(groups, [&](std::int64_t group) { writer.integer(group); });
      if (!isPoint)
      {
        writer.size(1);
        writer.integer(-4);
      }
    };
    entity(1, 3, { 70 }, true);
    entity(1, 6, { 71 }, false);
    entity(1, 6, { 42, 43 }, false);
    writer.text("\n$EndEntities\n");
    writer.nodes({ 1, 2, 3, 4 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
    writer.elements({ { 4, { 1, 2, 3, 4 } } });
    const ReadMesh mesh = this->gmsh(writer.bytes());
    ASSERT_EQ(mesh.elementColumns.size(), 2u); // and CellGroups, with both groups
    EXPECT_EQ(mesh.elementColumns[0].spec.name, "PhysicalTag");
    EXPECT_EQ(valuesOf(mesh.elementColumns[0]), (std::vector<double>{ 42 }));
  }
}

TEST_F(ImportGmsh, ABorderBetweenPartsIsInNoGroup)
{
  const ReadMesh mesh = this->gmsh(
    Format4 + "$PhysicalNames\n1\n3 5 \"body\"\n$EndPhysicalNames\n"
              "$PartitionedEntities\n2\n0\n0 0 1 2\n"
              "3 3 1 2 1 2 0 0 0 1 1 1 1 5 0\n"
              "2 3 1 1 1 0 0 0 1 1 1 1 5 0\n3 3 1 1 2 0 0 0 1 1 1 1 5 0\n$EndPartitionedEntities\n"
              "$Nodes\n1 5 1 5\n3 2 0 5\n1\n2\n3\n4\n5\n"
              "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n$EndNodes\n"
              "$Elements\n3 3 1 3\n2 3 2 1\n1 1 2 3\n3 2 4 1\n2 1 2 3 4\n3 3 4 1\n3 1 3 2 5\n"
              "$EndElements\n");
  EXPECT_EQ(mesh.groups.groups, (std::vector<Group>{ { "body", 5, GroupOf::Cells } }));
  EXPECT_EQ(mesh.facets.size(), 0u);
  EXPECT_EQ(mesh.counts.droppedCells, 1);
}

TEST_F(ImportGmsh, TheGroupsOfVeryManyEntitiesCountWithinTheMemory)
{
  const auto with = [](int points)
  {
    std::string bytes =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n" + std::to_string(points) + " 0 0 0\n";
    for (int k = 1; k <= points; ++k)
    {
      bytes += std::to_string(k) + " 0 0 0 1 7\n";
    }
    return bytes + "$EndEntities\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n"
                   "$EndNodes\n$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";
  };
  EXPECT_EQ(this->gmsh(with(50000)).corners, (Numbers{ 0, 1, 2 }));
  this->expectRefused(with(300000), "the conversion needs at least ");
}

TEST_F(ImportGmsh, KindsOfCellsAreChosen)
{
  const std::string bytes =
    Format2 + Nodes2 + "$Elements\n2\n1 2 0 1 2 3\n2 4 0 1 2 3 4\n$EndElements\n";
  // Those of the highest dimension; a triangle in no group is dropped.
  const ReadMesh mesh = this->gmsh(bytes);
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 3 }));
  EXPECT_EQ(mesh.counts.droppedCells, 1);
  EXPECT_EQ(this->gmsh(bytes, CellChoice::Tetrahedra).corners, (Numbers{ 0, 1, 2, 3 }));
  EXPECT_EQ(this->gmsh(bytes, CellChoice::Triangles).corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportGmsh, OnlyCornersOfHigherOrderElementsAreUsed)
{
  // Types with their numbers of nodes, from the reference manual of Gmsh.
  constexpr std::array<std::pair<int, int>, 31> types{ { { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 4 },
    { 5, 8 }, { 6, 6 }, { 7, 5 }, { 8, 3 }, { 9, 6 }, { 10, 9 }, { 11, 10 }, { 12, 27 }, { 13, 18 },
    { 14, 14 }, { 15, 1 }, { 16, 8 }, { 17, 20 }, { 18, 15 }, { 19, 13 }, { 20, 9 }, { 21, 10 },
    { 22, 12 }, { 23, 15 }, { 24, 15 }, { 25, 21 }, { 26, 4 }, { 27, 5 }, { 28, 6 }, { 29, 20 },
    { 30, 35 }, { 31, 56 } } };
  for (const auto choice : { CellChoice::Triangles, CellChoice::Tetrahedra })
  {
    GmshWriter writer(GmshVariants[2]);
    std::vector<GmshElement> elements;
    for (const auto& [type, nodes] : types)
    {
      GmshElement element{ type, Numbers(static_cast<std::size_t>(nodes)) };
      std::iota(element.nodes.begin(), element.nodes.end(), 1);
      elements.push_back(element);
    }
    Numbers tags(56);
    std::iota(tags.begin(), tags.end(), 1);
    writer.nodes(tags, std::vector<std::array<double, 3>>(56));
    writer.elements(elements);
    const ReadMesh mesh = this->gmsh(writer.bytes(), choice);
    EXPECT_LT(*std::ranges::max_element(mesh.corners), 8);
    if (choice == CellChoice::Triangles)
    {
      // Triangles 2, 9, 20 to 25; quadrilaterals 3, 10, 16.
      EXPECT_EQ(mesh.cells(), 8 + 2 * 3);
      EXPECT_EQ(mesh.counts.higherOrderCells, 7 + 2);
    }
    else
    {
      // Tetrahedra 4, 11, 29 to 31; hexahedra 5, 12, 17; prisms 6, 13, 18; pyramids 7, 14, 19.
      EXPECT_EQ(mesh.cells(), 5 + 6 * 3 + 3 * 3 + 2 * 3);
      EXPECT_EQ(mesh.counts.higherOrderCells, 4 + 2 + 2 + 2);
    }
  }
}

TEST_F(ImportGmsh, ParametersOfNodesArePassed)
{
  for (const GmshVariant& variant : { GmshVariants[1], GmshVariants[4], GmshVariants[5] })
  {
    GmshWriter writer(variant);
    writer.text("$Nodes\n");
    for (const std::int64_t size : { 3, 4, 1, 4 })
    {
      writer.size(size);
    }
    const auto block = [&writer](int dimension, int parametric, const Numbers& tags)
    {
      writer.integer(dimension);
      writer.integer(1);
      writer.integer(parametric);
      writer.size(std::int64_t(tags.size()));
      for (const std::int64_t tag : tags)
      {
        writer.size(tag);
      }
      for (const std::int64_t tag : tags)
      {
        for (int k = 0; k < 3; ++k)
        {
          writer.real(k + 1 == tag - 1 ? 1 : 0);
        }
        for (int k = 0; k < dimension * parametric; ++k)
        {
          writer.real(0.125);
        }
      }
    };
    block(2, 1, { 1, 2 });
    block(0, 1, { 3 });
    block(3, 0, { 4 });
    writer.text("\n$EndNodes\n");
    writer.elements({ { 4, { 1, 2, 3, 4 } } });
    const ReadMesh mesh = this->gmsh(writer.bytes());
    EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }));
  }
}

namespace
{

/** A file of version 4.0: a tetrahedron of volume 7, in group 5, with gaps between the tags. */
std::string fourZero(bool binary)
{
  std::string bytes = std::string("$MeshFormat\n4.0 ") + (binary ? "1 8\n" : "0 8\n");
  const auto numbers = [&]<class T>(std::initializer_list<T> values)
  {
    for (const T value : values)
    {
      if (binary)
      {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
      }
      else
      {
        bytes += exact(static_cast<double>(value)) + ' ';
      }
    }
    bytes += binary ? "" : "\n";
  };
  using Long = std::uint64_t;
  if (binary)
  {
    numbers({ 1 });
    bytes += '\n';
  }
  bytes += "$EndMeshFormat\n$Entities\n";
  numbers({ Long(1), Long(1), Long(0), Long(1) });
  numbers({ 1 }); // a point, which has a box in this version
  numbers({ 0., 0., 0., 0., 0., 0. });
  numbers({ Long(0) });
  numbers({ 2 }); // a curve, which ends at the point
  numbers({ 0., 0., 0., 1., 0., 0. });
  numbers({ Long(0), Long(1) });
  numbers({ 1 });
  numbers({ 7 }); // the volume
  numbers({ 0., 0., 0., 1., 1., 1. });
  numbers({ Long(1) });
  numbers({ 5 });
  numbers({ Long(0) });
  bytes += binary ? "\n" : "";
  bytes += "$EndEntities\n$Nodes\n";
  numbers({ Long(2), Long(4) });
  numbers({ 2, 1, 1 }); // on the curve, with a parameter
  numbers({ Long(1) });
  numbers({ 30 });
  numbers({ 0., 0., 0., 0.5 });
  numbers({ 7, 3, 0 });
  numbers({ Long(3) });
  for (const int tag : { 10, 20, 40 })
  {
    numbers({ tag });
    numbers({ tag == 10 ? 1. : 0., tag == 20 ? 1. : 0., tag == 40 ? 1. : 0. });
  }
  bytes += binary ? "\n" : "";
  bytes += "$EndNodes\n$Elements\n";
  numbers({ Long(1), Long(1) });
  numbers({ 7, 3, 4 });
  numbers({ Long(1) });
  numbers({ 1, 30, 10, 20, 40 });
  bytes += binary ? "\n" : "";
  return bytes + "$EndElements\n";
}

} // namespace

TEST_F(ImportGmsh, OlderVersionsAreRead)
{
  const std::string nodes = "4\n30 0 0 0\n10 1 0 0\n20 0 1 0\n40 0 0 1\n";
  const std::string first =
    "$NOD\n" + nodes + "$ENDNOD\n$ELM\n2\n1 15 0 1 1 30\n2 4 5 7 4 30 10 20 40\n$ENDELM\n";
  const std::string parametric =
    Format2 + "$ParametricNodes\n4\n30 0 0 0 0 1\n10 1 0 0 1 2 0.5\n20 0 1 0 2 3 0.5 0.25\n"
              "40 0 0 1 3 7\n$EndParametricNodes\n$Elements\n1\n1 4 2 5 7 30 10 20 40\n"
              "$EndElements\n";
  for (const std::string& bytes : { first, parametric, fourZero(false), fourZero(true) })
  {
    const ReadMesh mesh = this->gmsh(bytes);
    EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }));
    EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 3 }));
    ASSERT_EQ(mesh.elementColumns.size(), 3u); // and CellGroups
    EXPECT_EQ(mesh.elementColumns[0].value(mesh.elementCount - 1), 5);
    EXPECT_EQ(mesh.elementColumns[1].value(mesh.elementCount - 1), 7);
  }
  this->expectRefused("$NOD\n" + nodes + "$ENDNOD\n$ELM\n1\n2 4 5 7 3 30 10 20\n$ENDELM\n",
    "line 10: an element of 3 nodes has a type of 4");
}

TEST_F(ImportGmsh, OtherSectionsOfBinaryFilesArePassed)
{
  GmshWriter writer(GmshVariants[4]);
  // Longer than the window of a file in memory, with its end between two windows or not.
  std::string periodic((std::size_t(2) << 20) + 12345, '\n');
  periodic.replace(5000, 8, "$EndPeri");
  writer.text("$Periodic\n" + periodic + "\n$EndPeriodic\n");
  writer.nodes({ 1, 2, 3, 4 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } });
  writer.elements({ { 4, { 1, 2, 3, 4 } } });
  EXPECT_EQ(this->gmsh(writer.bytes()).cells(), 1);
  const std::string cut = writer.bytes().substr(0, 2000000);
  this->expectRefused(cut, "a.msh, byte 2000000: the file is truncated: '$EndPeriodic' is missing");
}

TEST_F(ImportGmsh, ErrorsOfTextNameTheLine)
{
  this->expectRefused(Nodes2 + Elements2, "a.msh, line 1: the section $MeshFormat is missing");
  this->expectRefused("$MeshFormat\n3.0 0 8\n$EndMeshFormat\n", "line 2: this version");
  this->expectRefused("$MeshFormat\n2.2 2 8\n$EndMeshFormat\n", "line 2: the kind of file");
  this->expectRefused(Format2 + Elements2 + Nodes2, "line 4: the elements come before");
  this->expectRefused(Format2 + Nodes2 + Nodes2 + Elements2, "line 11: there are two sections");
  this->expectRefused(Format2 + Nodes2, "no triangles and no tetrahedra");
  this->expectRefused(Format2 + "$Nodes\n5\n1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n$EndNodes\n",
    "line 10: '$EndNodes' is not an integer");
  this->expectRefused(Format2 + "$Nodes\n3\n1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n$EndNodes\n",
    "line 9: '4' stands where '$EndNodes'");
  this->expectRefused(Format2 + "$Nodes\n999999999\n1 0 0 0\n", "line 5: 999999999 cannot be");
  this->expectRefused(Format2 + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n", "two nodes 1");
  this->expectRefused(Format2 + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "line 6: 'nan' is not finite");
  const auto element = [](const std::string& row)
  { return Format2 + Nodes2 + "$Elements\n1\n" + row + "\n$EndElements\n"; };
  this->expectRefused(element("1 4 0 1 2 3 5"), "line 13: the corner 5");
  this->expectRefused(element("1 4 0 0 2 3 4"), "line 13: the corner 0");
  this->expectRefused(element("1 4 0 -1 2 3 4"), "line 13: the corner -1");
  this->expectRefused(element("1 34 0 1 2 3"), "line 13: elements of type 34 are not known");
  this->expectRefused(element("1 4 -1 1 2 3 4"), "line 13: -1 cannot be");
  this->expectRefused(
    Format2 + Nodes2 + "$Elements\n1\n1 4 0 1 2 3 4\n", "'$EndElements' is missing");
  this->expectRefused(Format2 + Nodes2 + Elements2 + "$Extra\n1\n", "'$EndExtra' is missing");
  this->expectRefused(Format4 + "$Nodes\n1 2 1 2\n3 1 0 1\n1\n0 0 0\n$EndNodes\n", "says 2");
  this->expectRefused(Format4 + "$Nodes\n1 1 1 1\n4 1 0 1\n1\n0 0 0\n$EndNodes\n", "line 6");
}

TEST_F(ImportGmsh, ACornerWithoutANodeIsRefusedWhereTagsHaveGaps)
{
  this->expectRefused(Format2 + "$Nodes\n3\n1 0 0 0\n9 0 0 0\n5 0 0 0\n$EndNodes\n$Elements\n1\n"
                                "1 2 0 1 5 7\n$EndElements\n",
    ", counted from 0, names a vertex that the file does not have");
}

TEST_F(ImportGmsh, ErrorsOfBinaryFilesNameTheByte)
{
  const std::string format = "$MeshFormat\n2.2 1 8\n";
  this->expectRefused(format + std::string("\1\1\0\0\n", 5) + "$EndMeshFormat\n", "byte order");
  this->expectRefused("$MeshFormat\n2.2 1 4\n", "numbers of 4 bytes");
  for (const GmshVariant& variant : { GmshVariants[2], GmshVariants[4] })
  {
    GmshWriter repeated(variant);
    repeated.nodes({ 1, 3, 3 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
    this->expectRefused(repeated.bytes(), "there are two nodes 3");
    GmshWriter infinite(variant);
    infinite.nodes({ 1 }, { { 0, std::numeric_limits<double>::infinity(), 0 } });
    this->expectRefused(infinite.bytes(), "a.msh, byte ");
    this->expectRefused(infinite.bytes(), "a coordinate is not finite");
    GmshWriter wrong(variant);
    wrong.nodes({ 1, 2, 3 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
    wrong.elements({ { 2, { 1, 2, 4 } } });
    this->expectRefused(wrong.bytes(), "the corner 4");
    const std::string good = fourSolids(variant, consecutiveTags(1));
    this->expectRefused(good.substr(0, good.size() - 8), "$EndElements");
    this->expectRefused(good.substr(0, good.size() - 40), "the file");
  }
}

TEST_F(ImportGmsh, DamagedFilesAreRefusedOrValid)
{
  for (const GmshVariant& variant : GmshVariants)
  {
    this->expectSafe(GmshFormat, "a.msh", fourSolids(variant, consecutiveTags(1)));
  }
  const Numbers tags{ 1, 2, 40, 3, 99, 7, 5, 4, 90, 13, 12, 11 };
  this->expectSafe(GmshFormat, "a.msh", fourSolids(GmshVariants[1], tags));
}

TEST_F(ImportGmsh, ArchiveMeshHasItsCounts)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  const ReadMesh mesh = this->readFile(GmshFormat, folder / "armadillo_tet.msh");
  EXPECT_EQ(mesh.vertices(), 13230);
  EXPECT_EQ(mesh.cells(), 54985);
}

} // namespace smg::testing
