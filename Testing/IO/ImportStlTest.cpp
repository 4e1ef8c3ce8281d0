// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/ImportFixture.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace smg::testing
{
namespace
{

using ImportStl = ImportFixture;

const std::string Stl = "solid two\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                        "vertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

using Coordinates = std::array<float, 9>;

std::string binaryStl(const std::vector<Coordinates>& triangles, const char* header)
{
  std::string bytes = header;
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const Coordinates& triangle : triangles)
  {
    bytes.append(12, '\0');
    for (const float coordinate : triangle)
    {
      put(bytes, coordinate);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string twoTriangles(const char* header = "solid, but binary")
{
  return binaryStl({ { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 1, -0.0f, 0, 1, 1, 0, 0, 1, 0 } }, header);
}

/** Triangles of a torus with corners in any order, so that vertices recur far away. */
std::vector<Coordinates> manyTriangles(int count)
{
  Random random(11);
  std::vector<Coordinates> triangles(static_cast<std::size_t>(count));
  for (Coordinates& triangle : triangles)
  {
    for (float& coordinate : triangle)
    {
      coordinate = static_cast<float>(random.below(90)) - 45.0f;
    }
  }
  return triangles;
}

} // namespace

TEST_F(ImportStl, CornersAreWelded)
{
  for (const std::string& bytes : { Stl, twoTriangles(), twoTriangles("binary") })
  {
    const ReadMesh mesh = this->read("a.stl", bytes);
    EXPECT_EQ(mesh.doublePositions, bytes == Stl);
    EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }));
    EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 1, 3, 2 }));
  }
}

TEST_F(ImportStl, TextIsOfDoublePrecision)
{
  const ReadMesh mesh = this->read("a.stl",
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 448000.12 5412345.678 101.5\n"
    "vertex 448000.13 5412345.678 101.5\nvertex 448000.12 5412345.789 1e39\nendloop\nendfacet\n"
    "endsolid\n");
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 448000.12, 5412345.678, 101.5, 448000.13,
                              5412345.678, 101.5, 448000.12, 5412345.789, 1e39 }));
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2 }));
}

TEST_F(ImportStl, WeldingOutOfCoreIsWeldingInMemory)
{
  // A multiple of the capacity of the minimum memory: corners and vertices are sorted on disk.
  const std::vector<Coordinates> triangles = manyTriangles(400000);
  std::map<std::array<float, 3>, std::int64_t> vertices;
  Numbers corners;
  std::vector<double> positions;
  for (const Coordinates& triangle : triangles)
  {
    for (std::size_t k = 0; k < 9; k += 3)
    {
      const std::array<float, 3> point{ triangle[k], triangle[k + 1], triangle[k + 2] };
      const auto [entry, fresh] =
        vertices.try_emplace(point, static_cast<std::int64_t>(vertices.size()));
      if (fresh)
      {
        positions.insert(positions.end(), point.begin(), point.end());
      }
      corners.push_back(entry->second);
    }
  }
  const ReadMesh mesh = this->read("a.stl", binaryStl(triangles, "many"));
  EXPECT_TRUE(mesh.positions == positions);
  EXPECT_TRUE(mesh.corners == corners);
}

TEST_F(ImportStl, TrianglesThatShareNothingKeepTheirCorners)
{
  std::vector<Coordinates> triangles(200000);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 9; ++k)
    {
      triangles[i][k] = static_cast<float>(i) + 0.01f * static_cast<float>(k * k);
    }
  }
  const ReadMesh mesh = this->read("soup.stl", binaryStl(triangles, "soup"));
  EXPECT_EQ(mesh.vertices(), 3 * static_cast<std::int64_t>(triangles.size()));
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
  {
    ASSERT_EQ(mesh.corners[i], static_cast<std::int64_t>(i));
    ASSERT_EQ(mesh.positions[3 * i], triangles[i / 3][i % 3 * 3]);
  }
}

TEST_F(ImportStl, FacetsMayHaveMoreCornersAndFilesMoreSolids)
{
  const ReadMesh mesh = this->read("a.stl",
    "  solid a b c\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
    "vertex 0 1 0\nendloop\nendfacet\nendsolid a\nsolid empty\nfacet normal 0 0 0\nouter loop\n"
    "vertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid empty\n");
  EXPECT_EQ(mesh.corners, (Numbers{ 0, 1, 2, 0, 2, 3 }));
  EXPECT_EQ(mesh.counts.triangulatedPolygons, 1);
  EXPECT_EQ(mesh.counts.droppedCells, 1);
}

TEST_F(ImportStl, ErrorsNameFileAndPlace)
{
  std::string infinite = twoTriangles();
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 50 + 12, &infinity, sizeof(infinity));
  this->expectError("a.stl", infinite, "byte 134: triangle 1: a coordinate is not finite");
  this->expectError("a.stl", twoTriangles("binary").substr(0, 150), "2 triangles take 184 bytes");
  this->expectError("a.stl", "too short", "too short for an STL file");
  this->expectError("a.stl", Stl.substr(0, Stl.size() - 10), "must end with 'endsolid'");
  this->expectError("a.stl", "solid\nfacet\nvertex 0 0 0\n", "line 3: there is a vertex before");
  this->expectError("a.stl", "solid\nfacet\nouter loop\nouter loop\n", "line 4: a loop begins");
  this->expectError("a.stl", "solid\nfacet\nendloop\n", "line 3: a loop ends");
  this->expectError(
    "a.stl", "solid\nfacet\nouter loop\nvertex 0 0 1e309\n", "'1e309' is not finite");
  this->expectError("a.stl", "solid\nfacet\ncorner 0 0 0\n", "line 3: 'corner' is not a keyword");
  this->expectError("a.stl", "solid\nendsolid\n", "no triangles");
}

TEST_F(ImportStl, LinesAfterTheLastSolidAreRead)
{
  for (const char* tail : { "", "\n", " \n\n", "# a comment\n", "\x1a", "\x1a\x1a\n", "--\n" })
  {
    EXPECT_EQ(this->read("a.stl", Stl + tail).cells(), this->read("b.stl", Stl).cells()) << tail;
  }
  EXPECT_EQ(this->read("a.stl", Stl + std::string(3, '\0')).cells(), 2);
  const std::pair<const char*, const char*> others[] = { { "garbage here\n",
                                                           "'garbage' is not a keyword" },
    { "sol", "'sol' is not a keyword" }, { "solid b\nfac", "'fac' is not a keyword" },
    { "facet wrong\n", "must end with 'endsolid'" }, { "solid b\n", "must end with 'endsolid'" },
    { "facet\nouter loop\n", "must end with" }, { "1 2 3\n", "'1' is not a keyword" } };
  for (const auto& [tail, part] : others)
  {
    this->expectError("a.stl", Stl + tail, part);
  }
}

TEST_F(ImportStl, BytesAfterTheLastTriangleAreNoted)
{
  EXPECT_TRUE(this->read("a.stl", twoTriangles("binary")).counts.notes.empty());
  const ReadMesh mesh = this->read("a.stl", twoTriangles("binary") + "more");
  EXPECT_EQ(mesh.cells(), 2);
  EXPECT_EQ(mesh.counts.notes.size(), 1u);
}

TEST_F(ImportStl, AttributeBytesAreRecognisedBySize)
{
  const std::vector<Coordinates> triangles = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 },
    { 1, 0, 0, 1, 1, 0, 0, 1, 0 }, { 0, 0, 0, 0, 1, 0, 0, 0, 1 } };
  const ReadMesh plain = this->read("plain.stl", binaryStl(triangles, "plain"));
  struct Case
  {
    std::vector<std::uint16_t> numbers; ///< of attribute bytes of the triangles
    bool follow;                        ///< whether these bytes are in the file
    std::size_t tail;                   ///< bytes after the last triangle
    std::string error;                  ///< none: it is read
    std::size_t notes;
  };
  const std::vector<Case> cases = { { { 0, 0, 0 }, true, 0, "", 0 },
    { { 2, 2, 2 }, true, 0, "", 1 }, { { 0, 7, 300 }, true, 0, "", 1 },
    { { 50, 0, 0 }, true, 0, "", 1 }, { { 0x7fff, 0, 31 }, false, 0, "", 0 },
    { { 0, 0, 0 }, true, 3, "", 1 }, { { 2, 2, 2 }, false, 3, "not the attribute bytes", 0 },
    { { 2, 2, 2 }, true, 1, "not the attribute bytes", 0 },
    { { 0, 0, 0 }, true, 70, "their number at the beginning is wrong", 0 } };
  for (const char* header : { "solid text", "binary", "" })
  {
    for (const Case& each : cases)
    {
      std::string bytes = binaryStl(triangles, header).substr(0, 84);
      for (std::size_t t = 0; t < triangles.size(); ++t)
      {
        bytes += binaryStl({ triangles[t] }, header).substr(84, 48);
        put(bytes, each.numbers[t]);
        bytes.append(each.follow ? each.numbers[t] : 0, 'a');
      }
      bytes.append(each.tail, 't');
      if (!each.error.empty())
      {
        this->expectError("a.stl", bytes, each.error);
        continue;
      }
      const ReadMesh mesh = this->read("a.stl", bytes);
      EXPECT_EQ(mesh.positions, plain.positions);
      EXPECT_EQ(mesh.corners, plain.corners);
      EXPECT_EQ(mesh.counts.notes.size(), each.notes);
    }
  }
}

TEST_F(ImportStl, TextIsRecognisedInAnyCaseAndAfterComments)
{
  std::string upper = Stl;
  std::ranges::transform(upper, upper.begin(),
    [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  const ReadMesh mesh = this->read("a.stl", Stl);
  std::string comments = "# a\n; b\n\n// c\n" + Stl;
  comments.insert(comments.find("facet"), "# solid two\n");
  for (const std::string& text : { upper, comments, "\xEF\xBB\xBF" + Stl })
  {
    for (const char* name : { "a.stl", "a" })
    {
      EXPECT_EQ(this->read(name, text).positions, mesh.positions) << text;
    }
  }
}

TEST_F(ImportStl, SolidsAreNumberedByName)
{
  const auto solid = [](const std::string& name, const std::string& corner)
  {
    return "solid " + name +
           "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + corner +
           "\nendloop\nendfacet\nendsolid " + name + "\n";
  };
  const std::string inlet = solid("the inlet", "0 1 0");
  const std::string wall = solid("wall", "0 0 1");
  EXPECT_TRUE(this->read("one.stl", inlet + solid("the inlet", "0 0 1")).elementColumns.empty());
  const ReadMesh mesh = this->read(
    "a.stl", inlet + "solid empty\nendsolid empty\n" + wall + solid("the inlet", "1 1 1"));
  ASSERT_EQ(mesh.elementColumns.size(), 1u);
  EXPECT_EQ(mesh.elementColumns[0].spec, (ColumnSpec{ "Solid", ScalarType::Int64, 1 }));
  EXPECT_EQ(Numbers(mesh.elementColumns[0].as<std::int64_t>().begin(),
              mesh.elementColumns[0].as<std::int64_t>().end()),
    (Numbers{ 0, 1, 0 }));
  ASSERT_EQ(mesh.counts.notes.size(), 1u);
  EXPECT_NE(mesh.counts.notes[0].find("0 'the inlet', 1 'wall'."), std::string::npos)
    << mesh.counts.notes[0];
}

TEST_F(ImportStl, DamageIsFound)
{
  this->expectDamageIsFound("a.stl", Stl);
  this->expectDamageIsFound("b.stl", twoTriangles());
  this->expectDamageIsFound("c.stl", twoTriangles("binary"));
}

} // namespace smg::testing
