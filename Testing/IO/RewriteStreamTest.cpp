// SPDX-License-Identifier: BSD-3-Clause
#include "smg/WriteMesh.h"

#include "IO/Formats/Streams/StreamFile.h"
#include "Testing/IO/ShiftedSource.h"
#include "Testing/IO/StreamFormatsFixture.h"
#include "Testing/IO/StreamFormatsSamples.h"
#include "Testing/IO/WriteStream.h"
#include "Testing/Support/Combinations.h"
#include "Testing/Support/TestFolders.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

namespace smg::testing
{
namespace
{

/** A vertex or a cell of a streaming file. */
using Element = std::tuple<StreamEvent::Kind, std::array<float, 3>, std::array<std::int64_t, 4>,
  std::vector<float>, std::vector<std::int32_t>>;

/** The vertices and cells of a streaming file in its order. */
std::vector<Element> elementsOf(const std::filesystem::path& path)
{
  std::vector<Element> elements;
  const auto reader = openStreamFile(path);
  StreamEvent event;
  for (reader->next(event); event.kind != StreamEvent::End; reader->next(event))
  {
    const bool isVertex = event.kind == StreamEvent::Vertex;
    if (isVertex || event.kind == StreamEvent::Cell)
    {
      std::array<std::int64_t, 4> corners{};
      const int count = cornersOf(cellTypeOf(reader->header().format));
      std::copy_n(event.corners.begin(), isVertex ? 0 : count, corners.begin());
      elements.emplace_back(event.kind, isVertex ? event.position : std::array<float, 3>{}, corners,
        isVertex ? event.floats : std::vector<float>(), event.ints);
    }
  }
  return elements;
}

class RewriteStream : public StreamFormats
{
protected:
  /** Converts the file, moves the mesh along x and writes it again. */
  std::filesystem::path rewrite(
    const std::filesystem::path& in, const std::string& out, double shift = 0.0)
  {
    this->Result = streamToVsm(in, this->Folder / "out.vsm");
    EXPECT_TRUE(canRewrite(in, this->Folder / out));
    ShiftedSource moved(VsmReader(this->Folder / "out.vsm").source(), shift);
    RewriteOptions options;
    options.scratch = this->Folder.path();
    options.memory = 0;
    rewriteMesh(in, this->Folder / out, moved, options);
    return this->Folder / out;
  }

  /** Expects the same elements, finality and header for every format. */
  void expectSameStream(const std::filesystem::path& in, const std::filesystem::path& out)
  {
    EXPECT_TRUE(elementsOf(in) == elementsOf(out)) << in << ' ' << out;
    const StreamFileHeader before = openStreamFile(in)->header();
    const StreamFileHeader after = openStreamFile(out)->header();
    EXPECT_EQ(before.postOrder, after.postOrder);
    EXPECT_EQ(before.vertices, after.vertices);
    EXPECT_EQ(before.cells, after.cells);
    EXPECT_EQ(before.bounds.has_value(), after.bounds.has_value());
    const StreamToVsmResult first = streamToVsm(in, this->Folder / "a.vsm");
    const StreamToVsmResult second = streamToVsm(out, this->Folder / "b.vsm");
    EXPECT_EQ(first.info.width, second.info.width) << in << ' ' << out;
    EXPECT_EQ(first.isolatedVertices, second.isolatedVertices);
  }
};

TEST_F(RewriteStream, GivesTheSamplesBackByteForByte)
{
  for (const auto& [name, content] : { std::pair{ "a.sma", TwoTriangles },
         std::pair{ "a.smb", twoTrianglesBinary() }, std::pair{ "b.sma", TwoTrianglesPost },
         std::pair{ "a.sva", TwoTets }, std::pair{ "a.svb", twoTetsBinary() } })
  {
    const std::filesystem::path in = this->write(name, content);
    const std::filesystem::path out = this->rewrite(in, "again" + in.extension().string());
    EXPECT_EQ(readFile(out), content) << name;
  }
}

TEST_F(RewriteStream, KeepsTheOrderOfEveryVariant)
{
  Combinations combinations;
  for (const IndexedTestMesh& test : { torus(20, 30, 0.1), tetBox(6, 5, 6, 0.1) })
  {
    const StreamMesh mesh = singlePrecision(toStream(shuffled(test), TestOrder::Keep));
    const bool tets = mesh.cellType == CellType::Tetrahedron;
    for (int variant = 0; variant < 48; variant++)
    {
      if (!combinations.next())
      {
        continue;
      }
      const bool text = variant % 2 != 0;
      StreamStyle file;
      file.header.format = text ? (tets ? StreamFormat::Sva : StreamFormat::Sma)
                                : (tets ? StreamFormat::Svb : StreamFormat::Smb);
      file.header.postOrder = variant / 2 % 2 != 0;
      file.counts = file.bounds = variant / 4 % 2 != 0;
      file.finalization = static_cast<StreamStyle::Finalization>(variant / 8 % 3);
      file.bigEndian = variant / 24 % 2 != 0;
      file.endianFlag = file.bigEndian ? 1 : 0;
      if (!text && file.finalization == StreamStyle::Explicit)
      {
        continue;
      }
      const std::filesystem::path in =
        this->Folder / (text ? (tets ? "in.sva" : "in.sma") : (tets ? "in.svb" : "in.smb"));
      writeStream(in, mesh, file);
      this->expectSameStream(in, this->rewrite(in, tets ? "out.sva" : "out.sma"));
      this->expectSameStream(in, this->rewrite(in, tets ? "out.svb" : "out.smb"));
    }
  }
}

/** Isolated vertices, vertices long before their use, comments, lines of finality. */
const std::string Odd = "# odd\n# nverts 7\n# nfaces 2\n# bb_min 0 0 0\n# bb_max 9 9 9\n"
                        "v 9 9 9\nv 0 0 0\nv 5 5 5\nv 1 0 0\nv 0 1 0\nx 1\nf 5 2 4\n"
                        "v 1 1 0\nx 5\nf 4 6 2\nx 4\nx 6\nv 2 2 2\n";

TEST_F(RewriteStream, IsolatedVerticesStayWhereTheyAre)
{
  const std::filesystem::path in = this->write("odd.sma", Odd);
  const std::filesystem::path out = this->rewrite(in, "out.sma", 1.0);
  EXPECT_EQ(this->Result.isolatedVertices, 3);
  // A line of finality that does not follow a cell of the vertex stays a line.
  EXPECT_EQ(readFile(out), "# odd\n# nverts 7\n# nfaces 2\n# bb_min 1 0 0\n# bb_max 9 9 9\n"
                           "v 9 9 9\nv 1 0 0\nv 5 5 5\nv 2 0 0\nv 1 1 0\nx -5\nf 5 2 4\nv 2 1 0\n"
                           "x -2\nf -3 -1 2\nv 2 2 2\n");
  const std::filesystem::path binary = this->rewrite(in, "out.smb", 1.0);
  EXPECT_TRUE(elementsOf(out) == elementsOf(binary));
  EXPECT_TRUE(openStreamFile(binary)->header().comments.empty());
}

TEST_F(RewriteStream, KeepsFurtherValuesAndTheirRanges)
{
  const std::string text = "# svtype tet\n# nverts 5\n# ncells 1\n# v_pnum_f 4\n"
                           "# v_pmin_f 0 0 0 -1\n# v_pmax_f 1 1 1 7\n"
                           "v 1 0 0 7\nv 0 0 1 2\nv 0 0 0 -1\nv 0 1 0 0.5\nv 0 0 0 3\n"
                           "c -3 -5 -2 -4\n";
  const std::filesystem::path in = this->write("a.sva", text);
  EXPECT_EQ(readFile(this->rewrite(in, "out.sva")), text);
  this->expectSameStream(in, this->Folder / "out.sva");
  this->expectSameStream(in, this->rewrite(in, "out.svb"));
}

TEST_F(RewriteStream, RefusesAnotherMeshAndOtherCells)
{
  const std::filesystem::path in = this->write("a.sma", TwoTriangles);
  EXPECT_FALSE(canRewrite(in, this->Folder / "out.sva"));
  EXPECT_FALSE(canRewrite(in, this->Folder / "out.vsm"));
  EXPECT_FALSE(canRewrite(in, this->Folder / "out.ply"));
  streamToVsm(this->write("odd.sma", Odd), this->Folder / "odd.vsm");
  const auto refusal = [&](std::unique_ptr<MeshSource> moved, const char* out)
  { return messageOf([&] { rewriteMesh(in, this->Folder / out, *moved); }); };
  const VsmReader odd(this->Folder / "odd.vsm");
  EXPECT_NE(refusal(odd.source(), "out.sma").find("only 4 vertices"), std::string::npos);
  EXPECT_NE(refusal(odd.source({}, {}), "out.sma").find("OriginalId"), std::string::npos);
  EXPECT_NE(refusal(odd.source(), "out.svb").find("order of"), std::string::npos);
  for (const char* out : { "out.sma", "out.svb" })
  {
    EXPECT_FALSE(std::filesystem::exists(this->Folder / out));
  }
  this->convert(in);
  ShiftedSource far(VsmReader(this->Folder / "out.vsm").source(), 1e39);
  expectError([&] { rewriteMesh(in, this->Folder / "out.sma", far); }, "single precision");
  ShiftedSource near(VsmReader(this->Folder / "out.vsm").source(), 0);
  RewriteOptions options;
  options.progress = [](double) { return false; };
  EXPECT_THROW(rewriteMesh(in, this->Folder / "out.sma", near, options), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(this->Folder / "out.sma"));
  EXPECT_EQ(this->Folder.entries(), 4);
}

TEST_F(RewriteStream, MayWriteInPlace)
{
  const std::filesystem::path in = this->write("a.sma", TwoTriangles);
  this->rewrite(in, "a.sma", 1.0);
  this->rewrite(in, "a.sma", -1.0);
  EXPECT_EQ(readFile(in), TwoTriangles);
}

TEST_F(RewriteStream, KeepsTheOrderOfTheSamplesOfTheArchive)
{
  const std::filesystem::path samples = archiveFolder() / "streaming";
  if (archiveFolder().empty() || !std::filesystem::exists(samples))
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR names no folder with the samples";
  }
  Combinations combinations;
  for (const auto& entry : std::filesystem::directory_iterator(samples))
  {
    const std::filesystem::path& in = entry.path();
    if (in.extension() == ".smc" || !combinations.next())
    {
      continue;
    }
    const bool tets = cellTypeOf(detectStreamFormat(in)) == CellType::Tetrahedron;
    this->expectSameStream(in, this->rewrite(in, tets ? "out.sva" : "out.sma"));
    this->expectSameStream(in, this->rewrite(in, tets ? "out.svb" : "out.smb"));
  }
  const std::filesystem::path in = samples / "bunny_spectral_le.smb";
  EXPECT_TRUE(readFile(this->rewrite(in, "out.smb")) == readFile(in));
}

} // namespace
} // namespace smg::testing
