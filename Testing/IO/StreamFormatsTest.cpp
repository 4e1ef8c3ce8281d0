// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Formats/Streams/StreamFile.h"
#include "IO/Formats/Streams/StreamFileWriter.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/IO/StreamFormatsSamples.h"
#include "Testing/IO/WriteStream.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

namespace smg::testing
{
namespace
{

TEST_F(StreamFormats, ReadTheSamplesOfTheirDescription)
{
  const std::vector<double> triangles{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5 };
  for (const auto& [name, content] :
    { std::pair{ "a.sma", TwoTriangles }, std::pair{ "a.smb", twoTrianglesBinary() } })
  {
    const StreamMesh mesh = this->convert(this->write(name, content));
    EXPECT_EQ(mesh.positions, triangles);
    EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 1, 3, 2 }));
    EXPECT_EQ(this->Result.info.width, 3);
  }
  for (const auto& [name, content] :
    { std::pair{ "a.sva", TwoTets }, std::pair{ "a.svb", twoTetsBinary() } })
  {
    const StreamMesh mesh = this->convert(this->write(name, content));
    EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 3, 1, 2, 3, 4 }));
    EXPECT_EQ(this->Result.info.width, 4);
  }
  const StreamMesh mesh = this->convert(this->write("b.sma", TwoTrianglesPost));
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5 }));
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_TRUE(openStreamFile(this->Folder / "b.sma")->header().postOrder);
  const Column& ids = mesh.vertexColumns[0];
  EXPECT_EQ(ids.spec.name, "OriginalId");
  EXPECT_EQ((std::vector{ ids.value(0), ids.value(1), ids.value(2), ids.value(3) }),
    (std::vector<double>{ 0, 1, 3, 2 }));
}

TEST_F(StreamFormats, WriteTheSamplesOfTheirDescription)
{
  this->convert(this->write("in.sma", TwoTriangles));
  // Without a note: there are no columns but the original numbers.
  const std::vector<std::string> none;
  EXPECT_EQ(vsmToStream(this->Folder / "out.vsm", this->Folder / "out.sma"), none);
  EXPECT_EQ(vsmToStream(this->Folder / "out.vsm", this->Folder / "out.smb"), none);
  EXPECT_EQ(readFile(this->Folder / "out.sma"), TwoTriangles);
  EXPECT_EQ(readFile(this->Folder / "out.smb"), twoTrianglesBinary());
  this->convert(this->write("in.svb", twoTetsBinary()));
  vsmToStream(this->Folder / "out.vsm", this->Folder / "out.sva");
  vsmToStream(this->Folder / "out.vsm", this->Folder / "out.svb");
  EXPECT_EQ(readFile(this->Folder / "out.sva"), TwoTets);
  EXPECT_EQ(readFile(this->Folder / "out.svb"), twoTetsBinary());
}

TEST_F(StreamFormats, EveryVariantIsTheSameMesh)
{
  Combinations combinations;
  for (const IndexedTestMesh& test : { torus(40, 50, 0.1), tetBox(9, 9, 9, 0.1) })
  {
    const StreamMesh mesh = singlePrecision(toStream(test));
    const bool tets = mesh.cellType == CellType::Tetrahedron;
    for (int variant = 0; variant < 256; variant++)
    {
      if (!combinations.next())
      {
        continue;
      }
      const bool text = (variant & 1) != 0;
      StreamStyle file;
      file.header.format = tets ? (text ? StreamFormat::Sva : StreamFormat::Svb)
                                : (text ? StreamFormat::Sma : StreamFormat::Smb);
      file.header.postOrder = (variant & 2) != 0;
      file.counts = (variant & 4) != 0;
      file.bounds = (variant & 8) != 0;
      file.bigEndian = (variant & 16) != 0;
      file.endianFlag = (variant & 32) != 0 ? 1 : 0;
      file.finalization = (variant & 64) == 0           ? StreamStyle::InCell
                          : text && (variant & 16) != 0 ? StreamStyle::Explicit
                                                        : StreamStyle::None;
      if ((variant & 128) != 0)
      {
        file.header.comments = { "made by a test", "" };
      }
      writeStream(this->Folder / "in", mesh, file);
      const StreamMesh read = this->convert(this->Folder / "in");
      ASSERT_EQ(read.corners, mesh.corners) << variant;
      ASSERT_EQ(read.positions, mesh.positions) << variant;
      EXPECT_EQ(openStreamFile(this->Folder / "in")->header().postOrder, file.header.postOrder);
      EXPECT_EQ(this->Result.isolatedVertices, 0);
    }
  }
}

TEST_F(StreamFormats, AnyOrderIsConvertedInLittleMemory)
{
  const IndexedTestMesh test = shuffled(grid(400, 400));
  StreamFileHeader header;
  header.format = StreamFormat::Smb;
  header.vertices = test.vertices();
  header.cells = test.cells();
  StreamToVsmOptions options;
  options.memory = 1;
  for (const bool postOrder : { false, true })
  {
    header.postOrder = postOrder;
    const auto writer = createStreamFile(this->Folder / "in.smb", header);
    const auto vertices = [&]
    {
      for (std::int64_t v = 0; v < test.vertices(); v++)
      {
        const double* const p = &test.positions[3 * v];
        writer->vertex(std::array<float, 3>{ float(p[0]), float(p[1]), float(p[2]) });
      }
    };
    if (!postOrder)
    {
      vertices();
    }
    for (std::int64_t c = 0; c < test.cells(); c++)
    {
      writer->cell(std::span(test.corners).subspan(3 * c, 3));
    }
    if (postOrder)
    {
      vertices();
    }
    writer->finish();
    const StreamMesh mesh = this->convert(this->Folder / "in.smb", options);
    EXPECT_EQ(this->Folder.entries(), 2);
    const StreamMesh expected = toStream(test, TestOrder::Keep);
    EXPECT_TRUE(mesh.corners == expected.corners);
    EXPECT_TRUE(mesh.positions == singlePrecision(expected).positions);
    const Column& original = mesh.vertexColumns[0];
    EXPECT_TRUE(std::ranges::equal(original.as<std::int64_t>(), expected.originalIds));
  }
}

TEST_F(StreamFormats, IsolatedVerticesAreBesideTheStream)
{
  const std::string text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nx 1\nv 0 1 0\nv 8 8 8\nf 2 -3 4\nv 7 7 7\n";
  const StreamMesh mesh = this->convert(this->write("a.sma", text));
  EXPECT_EQ(this->Result.isolatedVertices, 3);
  EXPECT_EQ(mesh.positions, (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(mesh.vertexColumns[0].value(2), 3);
  EXPECT_EQ(this->Result.info.bounds[1], 1);
  VsmReader reader(this->Folder / "out.vsm");
  ASSERT_EQ(reader.isolatedVertices(), 3);
  IsolatedVertices isolated;
  reader.readIsolated(0, 3, isolated);
  EXPECT_EQ(isolated.ids, (std::vector<std::int64_t>{ 0, 4, 5 }));
  EXPECT_EQ(isolated.positions, (std::vector<double>{ 9, 9, 9, 8, 8, 8, 7, 7, 7 }));
}

TEST_F(StreamFormats, RepeatedCornersAreKept)
{
  const std::string text = "v 0 0 0\nv 1 0 0\nf -2 1 -1\n";
  const StreamMesh mesh = this->convert(this->write("a.sma", text));
  EXPECT_EQ(mesh.corners, (std::vector<std::int64_t>{ 0, 0, 1 }));
  vsmToStream(this->Folder / "out.vsm", this->Folder / "out.sma");
  EXPECT_NE(readFile(this->Folder / "out.sma").find("v 1 0 0\nf -2 1 -1\n"), std::string::npos);
}

TEST_F(StreamFormats, ScalarsBecomeColumns)
{
  const std::string text = "# svtype tet\n# v_pnum_f 4\n# v_pnum_i 2\n# c_pnum_i 1\n# c_pnum_f 1\n"
                           "v 0 0 0 0.5 -7 8\nv 1 0 0 1.5 9 10\nv 0 1 0 2.5 11 12\n"
                           "v 0 0 1 3.5 13 14\nc -4 -3 -2 -1 42 0.125\n";
  const StreamMesh mesh = this->convert(this->write("a.sva", text));
  ASSERT_EQ(mesh.vertexColumns.size(), 3U);
  EXPECT_EQ(mesh.vertexColumns[1].spec, (ColumnSpec{ "Scalar", ScalarType::Float32, 1 }));
  EXPECT_EQ(mesh.vertexColumns[1].value(2), 2.5);
  EXPECT_EQ(mesh.vertexColumns[2].spec, (ColumnSpec{ "IntegerScalar", ScalarType::Int32, 2 }));
  EXPECT_EQ(mesh.vertexColumns[2].value(3, 1), 14);
  ASSERT_EQ(mesh.cellColumns.size(), 2U);
  EXPECT_EQ(mesh.cellColumns[1].value(0), 42);

  vsmToStream(this->Folder / "out.vsm", this->Folder / "b.svb");
  const auto notes = vsmToStream(this->Folder / "out.vsm", this->Folder / "b.sva");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("vertex 'IntegerScalar'"), std::string::npos) << notes[0];
  EXPECT_EQ(notes[0].find("'Scalar'"), std::string::npos) << notes[0];
  EXPECT_EQ(notes[0].find("Original"), std::string::npos) << notes[0];
  EXPECT_NE(readFile(this->Folder / "b.sva").find("# v_pmin_f 0 0 0 0.5\n# v_pmax_f 1 1 1 3.5\n"),
    std::string::npos);
  for (const char* name : { "b.svb", "b.sva" })
  {
    const StreamMesh again = this->convert(this->Folder / name);
    ASSERT_EQ(again.vertexColumns.size(), 2U);
    EXPECT_EQ(again.vertexColumns[1].bytes, mesh.vertexColumns[1].bytes);
  }

  const std::string integers = "# svtype tet\n# v_pnum_f 3\n# v_pnum_i 1\nv 0 0 0 5\nv 1 0 0 6\n"
                               "v 0 1 0 7\nv 0 0 1 -8\nc -4 -3 -2 -1\n";
  this->convert(this->write("a.sva", integers));
  vsmToStream(this->Folder / "out.vsm", this->Folder / "c.svb");
  EXPECT_EQ(this->convert(this->Folder / "c.svb").vertexColumns[1].value(3), -8);
}

TEST_F(StreamFormats, LeaveNothingWhenCancelled)
{
  writeStream(this->Folder / "in.sma", toStream(grid(200, 200)), {});
  StreamToVsmOptions options;
  options.progress = [](double) { return false; };
  EXPECT_THROW(streamToVsm(this->Folder / "in.sma", this->Folder / "o.vsm", options), Cancelled);
  EXPECT_EQ(this->Folder.entries(), 1);
  double before = 0;
  options.progress = [&before](double fraction)
  {
    EXPECT_GE(fraction, before);
    before = fraction;
    return true;
  };
  streamToVsm(this->Folder / "in.sma", this->Folder / "o.vsm", options);
  EXPECT_EQ(before, 1.0);
  EXPECT_THROW(vsmToStream(this->Folder / "o.vsm", this->Folder / "o.sma", {},
                 [](double fraction) { return fraction < 0.5; }),
    Cancelled);
  EXPECT_EQ(this->Folder.entries(), 2);
}

TEST_F(StreamFormats, RefuseWhatDoesNotFitIn31Bits)
{
  StreamFileHeader header;
  header.format = StreamFormat::Smb;
  header.vertices = std::int64_t(1) << 31;
  EXPECT_NE(messageOf([&] { createStreamFile(this->Folder / "a.smb", header); }).find("2147483647"),
    std::string::npos);
  EXPECT_EQ(this->Folder.entries(), 0);
}

TEST_F(StreamFormats, WritersRefuseWhatTheHeaderDoesNotSay)
{
  StreamFileHeader header;
  header.format = StreamFormat::Sma;
  header.vertices = 2;
  const auto writer = createStreamFile(this->Folder / "a.sma", header);
  const std::array<float, 3> zero{};
  const std::array<std::int64_t, 3> cell{ 0, 0, 1 };
  writer->vertex(zero);
  EXPECT_NE(messageOf([&] { writer->cell(cell); }).find("uses vertex 1"), std::string::npos);
  EXPECT_NE(messageOf([&] { writer->cell(std::span(cell).first(2)); }), "");
  EXPECT_NE(messageOf([&] { writer->vertex(zero, std::span(zero).first(1)); }), "");
  EXPECT_NE(messageOf([&] { writer->finish(); }).find("1 vertices and 0 cells"), std::string::npos);
  header.vertexInts = 2;
  header.format = StreamFormat::Svb;
  EXPECT_NE(messageOf([&] { createStreamFile(this->Folder / "a.svb", header); }), "");
}

} // namespace
} // namespace smg::testing
