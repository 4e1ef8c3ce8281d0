// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/FormatTable.h"
#include "Testing/IO/VolumeImport.h"
#include "Testing/Support/TestFolders.h"

namespace smg::testing
{
namespace
{

const std::string Mixed = "MeshVersionFormatted 1\nDimension\n3\n# the points\nVertices 5\n"
                          "0 0 0 1\n1 0 0 1\n0 1 0 2\n0 0 1 2\n1 1 1 3\nCorners 1\n1\n"
                          "Triangles 1\n1 2 3 7\nTetrahedra\n2\n1 2 3 4 8\n2 3 4 5 9\nEnd\n";

/** A file with these lines after the dimension and four vertices of a tetrahedron. */
std::string fourVertices(const std::string& rest)
{
  return "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" +
         rest;
}

class ImportMedit : public VolumeImport
{
protected:
  ReadMesh medit(const std::string& text, CellChoice choice = CellChoice::Only)
  {
    return this->read(MeditFormat, "a.mesh", text, choice);
  }
  void expectRefused(const std::string& text, const std::string& part)
  {
    expectError([&] { this->medit(text); }, part);
  }
};

} // namespace

/** Edges, triangles and tetrahedra with references, and lists of each kind. */
const std::string Listed =
  fourVertices("Edges 3\n1 2 0\n2 3 5\n1 4 0\nTriangles 3\n1 2 3 7\n1 2 4 0\n2 3 4 7\n"
               "Tetrahedra 1\n1 2 3 4 9\nRidges 1\n3\nRequiredEdges 2\n1 3\n"
               "RequiredVertices 1\n2\nRequiredTriangles 2\n2 3\nCorners 4\n1 2 3 4\nEnd\n");

TEST_F(ImportMedit, ReferencesAndListsAreGroups)
{
  const ReadMesh solid = this->medit(Listed);
  EXPECT_EQ(solid.cells(), 1);
  EXPECT_EQ(solid.elementCount, 4);
  // Of edges in a volume both ends are members, in the order in which they came.
  EXPECT_EQ(
    groupCounts(solid), (GroupCounts{ { "cells 9", 1 }, { "facets 7", 2 }, { "facets required", 2 },
                          { "vertices 5", 2 }, { "vertices ridges", 2 }, { "vertices required", 5 },
                          { "vertices corners", 4 } }));
  const ReadMesh surface = this->medit(Listed, CellChoice::Triangles);
  EXPECT_EQ(surface.cells(), 3);
  EXPECT_EQ(
    groupCounts(surface), (GroupCounts{ { "cells 7", 2 }, { "cells required", 2 },
                            { "facets 5", 1 }, { "facets ridges", 1 }, { "facets required", 2 },
                            { "vertices required", 1 }, { "vertices corners", 4 } }));
  EXPECT_EQ(elementColumn(surface, "Reference").tuples(), 4u);
  this->expectRefused(fourVertices("Triangles 1\n1 2 3 0\nRequiredTriangles 1\n2\n"),
    "line 12: number 2 of the section 'RequiredTriangles' is not one of");
  this->expectSafe(MeditFormat, "a.mesh", Listed);
}

TEST_F(ImportMedit, FewLabelsOfVerticesAreGroups)
{
  const ReadMesh mesh = this->medit(Mixed);
  EXPECT_EQ(groupCounts(mesh),
    (GroupCounts{ { "cells 8", 1 }, { "cells 9", 1 }, { "facets 7", 1 }, { "vertices 1", 2 },
      { "vertices 2", 2 }, { "vertices 3", 1 }, { "vertices corners", 1 } }));
  std::string many = "MeshVersionFormatted 2\nDimension 3\nVertices 2000\n";
  for (int i = 1; i <= 2000; ++i)
  {
    many += std::to_string(i % 5) + ' ' + std::to_string(i) + " 0 " + std::to_string(i) + '\n';
  }
  EXPECT_TRUE(groupCounts(this->medit(many + "Triangles 1\n1 2 3 0\nEnd\n")).empty());
}

TEST_F(ImportMedit, KindsOfCellsAreChosen)
{
  EXPECT_EQ(this->medit(Mixed).cells(), 2);
  const ReadMesh tetrahedra = this->medit(Mixed, CellChoice::Tetrahedra);
  EXPECT_EQ(tetrahedra.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
  EXPECT_EQ(tetrahedra.elements, (std::vector<std::int64_t>{ 1, 2 }));
  EXPECT_EQ(tetrahedra.elementCount, 3);
  EXPECT_EQ(tetrahedra.counts.droppedCells, 0);
  const ReadMesh triangles = this->medit(Mixed, CellChoice::Triangles);
  EXPECT_EQ(triangles.corners, (std::vector<std::int64_t>{ 0, 1, 2 }));
}

TEST_F(ImportMedit, ReferencesAreColumns)
{
  const ReadMesh mesh = this->medit(Mixed, CellChoice::Tetrahedra);
  const ColumnSpec spec{ "Reference", ScalarType::Int64, 1 };
  ASSERT_EQ(mesh.vertexColumns.size(), 1u);
  EXPECT_EQ(mesh.vertexColumns[0].spec, spec);
  EXPECT_EQ(mesh.vertexColumns[0].value(4), 3);
  const Column& references = elementColumn(mesh, "Reference");
  EXPECT_EQ(references.spec, spec);
  EXPECT_EQ(references.value(0), 7);
  EXPECT_EQ(references.value(2), 9);
}

TEST_F(ImportMedit, ReferencesThatAreZeroAreNoColumns)
{
  const ReadMesh mesh = this->medit(fourVertices("Tetrahedra\n1\n1 2 3 4 5\n"));
  EXPECT_TRUE(mesh.vertexColumns.empty());
  EXPECT_EQ(elementColumn(mesh, "Reference").value(0), 5);
  // Labels may be missing.
  EXPECT_TRUE(this->medit(fourVertices("Tetrahedra\n1\n1 2 3 4\n")).elementColumns.empty());
}

TEST_F(ImportMedit, SolidsBecomeTetrahedra)
{
  std::string text = "MeshVersionFormatted 1\nDimension 3\n";
  constexpr const char* keywords[] = { "Hexahedra", "Pyramids", "Prisms", "Tetrahedra" };
  for (std::size_t i = 0; i < 4; ++i)
  {
    text += std::string(keywords[i]) + "\n1\n";
    for (const std::int64_t corner : FourSolids[i])
    {
      text += std::to_string(corner + 1) + ' ';
    }
    text += "0\n";
  }
  // The vertices may come last.
  text += "Vertices\n12\n";
  for (const auto& point : FourSolidsPoints)
  {
    text += exact(point[0]) + ' ' + exact(point[1]) + ' ' + exact(point[2]) + " 0\n";
  }
  expectFourSolids(this->medit(text));
}

TEST_F(ImportMedit, PlaneMeshesAndQuadrilaterals)
{
  const ReadMesh mesh = this->medit("MeshVersionFormatted 1 Dimension 2 Vertices 4\n0 0 0\n1 0 0\n"
                                    "1 1 0\n0 1 0\nQuadrilaterals 1\n1 2 3 4 0\nEnd");
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }));
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3 }));
  EXPECT_EQ(mesh.counts.triangulatedPolygons, 1);
}

TEST_F(ImportMedit, OtherSectionsArePassed)
{
  const ReadMesh mesh =
    this->medit(fourVertices("Normals\n1\n0.5 1e-3 -.5\n"
                             "NormalAtVertices\n1\n1 1\nTetrahedra 1\n1 2 3 4 0\nRequiredVertices\n"
                             "0\nEnd\nanything else"));
  EXPECT_EQ(mesh.cells(), 1);
  EXPECT_EQ(mesh.elementCount, 1);
}

TEST_F(ImportMedit, CellsOfHigherOrderAreNotLostSilently)
{
  const std::string straight = "Tetrahedra\n1\n1 2 3 4 0\n";
  this->expectRefused(
    fourVertices(straight + "TetrahedraP2\n1\n1 2 3 4 1 2 3 4 1 2 0\nEnd\n"), "'TetrahedraP2'");
  this->expectRefused(fourVertices(straight + "HexahedraQ2\n0\n"), "'HexahedraQ2'");
  EXPECT_EQ(this->medit(fourVertices(straight + "EdgesP2\n1\n1 2 3 0\nEnd\n")).cells(), 1);
}

TEST_F(ImportMedit, ErrorsNameTheLine)
{
  this->expectRefused("MeshVersionFormatted 1\nDimension 4\n", "a.mesh, line 2: the dimension");
  this->expectRefused(fourVertices("Tetrahedra\n1\n1 2 3 5 0\n"), "line 11: the corner 5");
  this->expectRefused(fourVertices("Tetrahedra\n1\n0 2 3 4 0\n"), "line 11: the corner 0");
  this->expectRefused(fourVertices("Tetrahedra\n1\n-1 2 3 4 0\n"), "line 11: the corner -1");
  this->expectRefused(fourVertices("Tetrahedra\n1\n1 2 3 99999999999999999999 0\n"), "line 11");
  this->expectRefused(fourVertices("Tetrahedra\n1\n1 2 3 9999999999 0\n"), "line 11");
  this->expectRefused(fourVertices("Tetrahedra\n1000000000000\n1 2 3 4 0\n"), "truncated");
  this->expectRefused(fourVertices("Tetrahedra\n-1\n1 2 3 4 0\n"), "line 10: -1 cannot be");
  this->expectRefused(fourVertices("Tetrahedra\n1\n1 2 3 4 0\n1 2 3 4 0\n"), "line 12: '1' stands");
  this->expectRefused(fourVertices("Tetrahedra\n2\n1 2 3 4 0\n 1 2 3"), "line 12");
  this->expectRefused(fourVertices("Vertices\n1\n1 2 3 0\n"), "two sections 'Vertices'");
  this->expectRefused(fourVertices("Tetrahedra\n0\n"), "no triangles and no tetrahedra");
  this->expectRefused("MeshVersionFormatted 1\nDimension 3\nVertices\n1\nnan 0 0 0\n", "line 5");
  this->expectRefused("MeshVersionFormatted 1\nDimension 3\nVertices\n1\n0 1e999 0 0\n", "line 5");
  this->expectRefused("MeshVersionFormatted 1\nDimension 3\nVertices\n9\n0 0 0 0\n", "line 4: 9");
}

TEST_F(ImportMedit, DamagedFilesAreRefusedOrValid)
{
  this->expectSafe(MeditFormat, "a.mesh", Mixed);
  this->expectSafe(MeditFormat, "a.mesh",
    fourVertices("Prisms\n1\n1 2 3 4 1 2 0\nTetrahedra\n2\n1 2 3 4 0\n1 2 4 3 1\nEnd\n"));
}

TEST_F(ImportMedit, ArchiveMeshHasItsCounts)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  const ReadMesh mesh =
    this->readFile(MeditFormat, folder / "bunny_tet.mesh", CellChoice::Tetrahedra);
  EXPECT_EQ(mesh.vertices(), 5433);
  EXPECT_EQ(mesh.cells(), 34055);
  EXPECT_TRUE(mesh.vertexColumns.empty());
}

namespace
{

/** Writes the numbers of a binary file, version 1 to 4. */
class MeditBytes
{
public:
  MeditBytes(int version, bool big)
    : Version(version)
    , Big(big)
  {
    this->put(std::int32_t(1));
    this->put(std::int32_t(version));
    this->section(3, 4); // the dimension
    this->put(std::int32_t(3));
  }

  void section(std::int32_t code, std::size_t bytes)
  {
    this->put(code);
    const std::size_t next = this->Bytes.size() + (this->Version >= 3 ? 8 : 4) + bytes;
    this->Version >= 3 ? this->put(static_cast<std::int64_t>(code == 54 ? 0 : next))
                       : this->put(static_cast<std::int32_t>(code == 54 ? 0 : next));
  }
  /** A section of integers. */
  void integers(std::int32_t code, const std::vector<std::int64_t>& numbers, std::int64_t entries)
  {
    this->section(code, (numbers.size() + 1) * (this->Version == 4 ? 8 : 4));
    this->integer(entries);
    for (const std::int64_t number : numbers)
    {
      this->integer(number);
    }
  }
  void integer(std::int64_t number)
  {
    this->Version == 4 ? this->put(number) : this->put(static_cast<std::int32_t>(number));
  }
  void real(double number)
  {
    this->Version == 1 ? this->put(static_cast<float>(number)) : this->put(number);
  }
  std::size_t vertexBytes() const
  {
    return 3 * (this->Version == 1 ? 4 : 8) + (this->Version == 4 ? 8 : 4);
  }
  const std::string& bytes() const { return this->Bytes; }

private:
  template <class T>
  void put(T value)
  {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof(value));
    if (this->Big)
    {
      std::ranges::reverse(raw);
    }
    this->Bytes += raw;
  }

  int Version;
  bool Big;
  std::string Bytes;
};

/** Two tetrahedra, as the mesh Mixed has them. */
std::string binaryMixed(int version, bool big)
{
  MeditBytes file(version, big);
  file.integers(13, { 1 }, 1); // corners, which are skipped
  file.section(4, (version == 4 ? 8 : 4) + 5 * file.vertexBytes());
  file.integer(5);
  const double points[5][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
  const std::int64_t labels[] = { 1, 1, 2, 2, 3 };
  for (int i = 0; i < 5; ++i)
  {
    for (const double coordinate : points[i])
    {
      file.real(coordinate);
    }
    file.integer(labels[i]);
  }
  file.integers(6, { 1, 2, 3, 7 }, 1);
  file.integers(8, { 1, 2, 3, 4, 8, 2, 3, 4, 5, 9 }, 2);
  file.section(54, 0);
  return file.bytes();
}

} // namespace

TEST_F(ImportMedit, BinaryFilesAreTheSame)
{
  const ReadMesh text = this->medit(Mixed, CellChoice::Tetrahedra);
  for (const int version : { 1, 2, 3, 4 })
  {
    for (const bool big : { false, true })
    {
      const ReadMesh mesh =
        this->read(BinaryMeditFormat, "a.meshb", binaryMixed(version, big), CellChoice::Tetrahedra);
      EXPECT_EQ(mesh.doublePositions, version > 1);
      EXPECT_EQ(mesh.positions, text.positions);
      EXPECT_EQ(mesh.corners, text.corners);
      EXPECT_EQ(mesh.elements, text.elements);
      ASSERT_EQ(mesh.vertexColumns.size(), 1u);
      EXPECT_TRUE(mesh.vertexColumns[0].bytes == text.vertexColumns[0].bytes);
      EXPECT_TRUE(mesh.elementColumns[0].bytes == text.elementColumns[0].bytes);
      TemporaryFolder folder;
      writeBytes(folder / "a", binaryMixed(version, big));
      EXPECT_EQ(formatOfFile(folder / "a"), &BinaryMeditFormat);
    }
  }
}

TEST_F(ImportMedit, DamageOfBinaryFilesIsFound)
{
  const auto expectRefused = [this](const std::string& bytes, const std::string& part)
  {
    expectError(
      [&] { this->read(BinaryMeditFormat, "a.meshb", bytes, CellChoice::Tetrahedra); }, part);
  };
  const std::string bytes = binaryMixed(2, false);
  for (std::size_t length = 1; length < bytes.size(); ++length)
  {
    expectRefused(bytes.substr(0, length), "a.meshb, byte");
  }
  const auto changed = [&bytes](std::size_t place, char value)
  { return std::string(bytes).replace(place, 1, 1, value); };
  expectRefused(changed(0, 2), "begins with the number 1");
  expectRefused(changed(4, 9), "the version 9 is not read");
  expectRefused(changed(12, 1), "which is before the end of this one");
  expectRefused(changed(16, 5), "the dimension must be 2 or 3");
  MeditBytes quadratic(2, false);
  quadratic.integers(30, {}, 0);
  expectRefused(quadratic.bytes(), "cells of higher order");
}

} // namespace smg::testing
