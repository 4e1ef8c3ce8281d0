// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/Formats/MeshFile.h"
#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Order/Assembly/CellFlagger.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestFolders.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

const Column* findColumn(const std::vector<Column>& columns, const std::string& name)
{
  const auto found = std::find_if(columns.begin(), columns.end(),
    [&name](const Column& column) { return column.spec.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

/** Expects the stream to be the mesh, by the original numbers of its vertices and cells. */
void expectSameMesh(const StreamMesh& stream, const IndexedTestMesh& mesh)
{
  const Column* ids = findColumn(stream.vertexColumns, OriginalIdName);
  const Column* cellIds = findColumn(stream.cellColumns, OriginalCellIdName);
  ASSERT_TRUE(ids && cellIds);
  ASSERT_EQ(stream.cells(), mesh.cells());
  const auto originals = ids->as<std::int64_t>();
  for (std::size_t i = 0; i < originals.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(stream.positions[3 * i + axis],
        mesh.positions[static_cast<std::size_t>(3 * originals[i]) + axis]);
    }
  }
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::vector<bool> seen(static_cast<std::size_t>(mesh.cells()));
  for (std::size_t c = 0; c < seen.size(); ++c)
  {
    const auto original = static_cast<std::size_t>(cellIds->as<std::int64_t>()[c]);
    ASSERT_FALSE(seen[original]);
    seen[original] = true;
    for (std::size_t k = 0; k < corners; ++k)
    {
      ASSERT_EQ(originals[static_cast<std::size_t>(stream.corners[c * corners + k])],
        mesh.corners[original * corners + k]);
    }
  }
}

/** Most vertices alive at once, counted vertex by vertex. */
std::int64_t widthOf(const StreamMesh& stream)
{
  const auto corners = static_cast<std::size_t>(cornersOf(stream.cellType));
  std::vector<std::size_t> first(static_cast<std::size_t>(stream.vertices()), SIZE_MAX);
  std::vector<std::size_t> last(first.size());
  for (std::size_t i = 0; i < stream.corners.size(); ++i)
  {
    const auto vertex = static_cast<std::size_t>(stream.corners[i]);
    first[vertex] = std::min(first[vertex], i / corners);
    last[vertex] = i / corners;
  }
  std::vector<std::int64_t> change(static_cast<std::size_t>(stream.cells()) + 1);
  for (std::size_t vertex = 0; vertex < first.size(); ++vertex)
  {
    ++change[first[vertex]];
    --change[last[vertex] + 1];
  }
  std::partial_sum(change.begin(), change.end(), change.begin());
  return *std::max_element(change.begin(), change.end());
}

std::int64_t spanOf(const StreamMesh& stream)
{
  const auto corners = static_cast<std::ptrdiff_t>(cornersOf(stream.cellType));
  std::int64_t span = 0;
  for (auto cell = stream.corners.begin(); cell != stream.corners.end(); cell += corners)
  {
    const auto [low, high] = std::minmax_element(cell, cell + corners);
    span = std::max(span, *high - *low);
  }
  return span;
}

class Conversion : public ::testing::Test
{
protected:
  std::filesystem::path write(const IndexedTestMesh& mesh)
  {
    const std::filesystem::path path =
      this->Folder / (mesh.cellType == CellType::Triangle ? "mesh.off" : "mesh.mesh");
    writeBytes(path, meshText(mesh));
    return path;
  }

  StreamMesh load(const std::filesystem::path& path) { return collect(*VsmReader(path).source()); }

  ConversionOptions options(StreamOrder order)
  {
    ConversionOptions options;
    options.order = order;
    options.scratch = this->Scratch.path();
    return options;
  }

  TemporaryFolder Folder;
  TemporaryFolder Scratch;
};

} // namespace

TEST_F(Conversion, EveryOrderKeepsTheMesh)
{
  const std::vector<IndexedTestMesh> meshes{ shuffled(torus(40, 30, 0.1)),
    shuffled(disjointUnion(grid(20, 15), sphere(2), { 30, 0, 0 })),
    shuffled(tetBox(7, 6, 5, 0.1)) };
  for (const IndexedTestMesh& mesh : meshes)
  {
    const std::filesystem::path in = this->write(mesh);
    for (const StreamOrder order :
      { StreamOrder::BreadthFirst, StreamOrder::Axis, StreamOrder::Keep, StreamOrder::Spectral })
    {
      const ConversionReport report = convert(in, this->Folder / "out.vsm", this->options(order));
      const StreamMesh stream = this->load(this->Folder / "out.vsm");
      expectSameMesh(stream, mesh);
      EXPECT_EQ(report.vertices, mesh.vertices());
      EXPECT_EQ(report.cells, mesh.cells());
      EXPECT_EQ(report.width, widthOf(stream));
      EXPECT_EQ(report.span, spanOf(stream));
      EXPECT_EQ(report.degenerate_cells + report.duplicate_cells, 0);
      EXPECT_FALSE(findColumn(stream.cellColumns, CellFlagsName));
    }
  }
  EXPECT_EQ(this->Scratch.entries(), 0);
}

TEST_F(Conversion, BreadthFirstOrderIsNarrow)
{
  const std::filesystem::path in = this->write(shuffled(grid(100, 20)));
  const ConversionReport bfs =
    convert(in, this->Folder / "bfs.vsm", this->options(StreamOrder::BreadthFirst));
  const ConversionReport keep =
    convert(in, this->Folder / "keep.vsm", this->options(StreamOrder::Keep));
  EXPECT_LT(bfs.width, 60);
  EXPECT_LT(bfs.span, 60);
  EXPECT_GT(keep.width, 1000);
}

TEST_F(Conversion, KeepKeepsTheOrderOfTheCells)
{
  const IndexedTestMesh mesh = shuffled(grid(20, 20));
  convert(this->write(mesh), this->Folder / "out.vsm", this->options(StreamOrder::Keep));
  const StreamMesh stream = this->load(this->Folder / "out.vsm");
  const auto ids = findColumn(stream.cellColumns, OriginalCellIdName)->as<std::int64_t>();
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
}

TEST_F(Conversion, OddCellsAreCountedAndFlagged)
{
  // 0: sound; 1: the same corners again; 2: a corner twice; 3: no area; 4: sound; vertex 6 unused.
  writeBytes(this->Folder / "odd.off",
    "OFF\n7 5 0\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n1 1 0\n0.5 0.5 1\n9 9 9\n"
    "3 0 1 2\n3 2 0 1\n3 1 1 2\n3 0 1 3\n3 1 4 2\n");
  writeBytes(this->Folder / "odd.sma",
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\nf 3 1 2\nf 2 2 3\nf 1 2 4\nf 2 5 3\n");
  for (const char* name : { "odd.off", "odd.sma" })
  {
    for (const StreamOrder order : { StreamOrder::BreadthFirst, StreamOrder::Keep })
    {
      const ConversionReport report =
        convert(this->Folder / name, this->Folder / "out.vsm", this->options(order));
      EXPECT_EQ(report.cells, 5);
      EXPECT_EQ(report.vertices, 5);
      EXPECT_EQ(report.isolated_vertices, std::string(name) == "odd.off" ? 2 : 0);
      EXPECT_EQ(report.degenerate_cells, 2);
      EXPECT_EQ(report.duplicate_cells, 1);
      const StreamMesh stream = this->load(this->Folder / "out.vsm");
      const Column* flags = findColumn(stream.cellColumns, CellFlagsName);
      ASSERT_TRUE(flags);
      const auto ids = findColumn(stream.cellColumns, OriginalCellIdName)->as<std::int64_t>();
      const std::array<int, 5> expected{ 0, DuplicateCell, DegenerateCell, DegenerateCell, 0 };
      for (std::size_t c = 0; c < 5; ++c)
      {
        EXPECT_EQ(flags->value(c), expected[static_cast<std::size_t>(ids[c])]);
      }
      // The flags do not change.
      const ConversionReport again = convert(
        this->Folder / "out.vsm", this->Folder / "again.vsm", this->options(StreamOrder::Keep));
      EXPECT_EQ(again.degenerate_cells, 2);
      EXPECT_EQ(again.duplicate_cells, 1);
      const StreamMesh kept = this->load(this->Folder / "again.vsm");
      EXPECT_EQ(findColumn(kept.cellColumns, CellFlagsName)->bytes, flags->bytes);
    }
  }
}

TEST_F(Conversion, AStreamMustHaveTheCellsThatAreWanted)
{
  const std::filesystem::path vsm = this->Folder / "mesh.vsm";
  convert(this->write(grid(5, 4)), vsm, {});
  for (const StreamOrder order : { StreamOrder::BreadthFirst, StreamOrder::Keep })
  {
    ConversionOptions options = this->options(order);
    options.cells = CellChoice::Tetrahedra;
    expectError([&] { convert(vsm, this->Folder / "out.vsm", options); },
      "mesh.vsm: the file has no tetrahedra");
    options.cells = CellChoice::Triangles;
    EXPECT_EQ(convert(vsm, this->Folder / "out.vsm", options).cells, 24);
  }
}

TEST_F(Conversion, EdgesAndComponentsAreCounted)
{
  // Three triangles on one edge, and a separate fourth one.
  writeBytes(this->Folder / "fan.off",
    "OFF\n8 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n5 0 0\n6 0 0\n5 1 0\n"
    "3 0 1 2\n3 0 1 3\n3 0 1 4\n3 5 6 7\n");
  const ConversionReport report = convert(this->Folder / "fan.off", this->Folder / "out.vsm");
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.nonmanifold_edges, 1);
  EXPECT_EQ(report.boundary_edges, 9);
}

TEST_F(Conversion, ConvertingAgainKeepsTheOriginalNumbers)
{
  const IndexedTestMesh mesh = shuffled(grid(30, 20));
  convert(this->write(mesh), this->Folder / "a.vsm", this->options(StreamOrder::Axis));
  convert(this->Folder / "a.vsm", this->Folder / "b.vsm", this->options(StreamOrder::BreadthFirst));
  convert(this->Folder / "b.vsm", this->Folder / "c.vsm", this->options(StreamOrder::Keep));
  expectSameMesh(this->load(this->Folder / "b.vsm"), mesh);
  expectSameMesh(this->load(this->Folder / "c.vsm"), mesh);
  EXPECT_EQ(this->load(this->Folder / "b.vsm").corners, this->load(this->Folder / "c.vsm").corners);
}

TEST_F(Conversion, StreamFormatsRoundTrip)
{
  for (const auto& [mesh, names] : { std::pair{ sphere(3), std::array{ "a.sma", "a.smb" } },
         std::pair{ tetBox(6, 5, 4), std::array{ "a.sva", "a.svb" } } })
  {
    const std::filesystem::path in = this->write(mesh);
    convert(in, this->Folder / "a.vsm", this->options(StreamOrder::BreadthFirst));
    const StreamMesh stream = this->load(this->Folder / "a.vsm");
    for (const char* name : names)
    {
      convert(in, this->Folder / name, this->options(StreamOrder::BreadthFirst));
      convert(this->Folder / name, this->Folder / "b.vsm", this->options(StreamOrder::Keep));
      EXPECT_EQ(this->load(this->Folder / "b.vsm").corners, stream.corners);
    }
  }
  EXPECT_THROW(convert(this->write(sphere(1)), this->Folder / "b.svb"), Error);
  EXPECT_EQ(this->Scratch.entries(), 0);
}

TEST_F(Conversion, VtkXmlHasTheMeshAndItsColumns)
{
  const std::filesystem::path in = this->write(sphere(1));
  convert(in, this->Folder / "a.vtp");
  convert(in, this->Folder / "a.vtu");
  convert(this->write(tetBox(3, 3, 3)), this->Folder / "b.vtu");
  EXPECT_THROW(convert(this->write(tetBox(3, 3, 3)), this->Folder / "b.vtp"), Error);
  std::ifstream stream(this->Folder / "a.vtp", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  EXPECT_NE(text.find("NumberOfPoints=\"42\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfPolys=\"80\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"OriginalId\""), std::string::npos);
  EXPECT_TRUE(text.ends_with("</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n"));
  EXPECT_EQ(text.find('\0'), std::string::npos);
  // The numbers of bytes and the characters of the ids, points, corners and offsets.
  const std::array<std::size_t, 5> arrays{ 42 * 8, 80 * 8, 42 * 24, 80 * 24, 80 * 8 };
  std::size_t at = 0;
  for (const std::size_t bytes : arrays)
  {
    at = text.find("format=\"binary\">\n", at) + 17;
    EXPECT_EQ(text.find("\n</DataArray>", at), at + 12 + (bytes + 2) / 3 * 4) << bytes;
  }
}

TEST_F(Conversion, SinglePrecisionStaysSingle)
{
  writeBytes(this->Folder / "a.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0.1 0 0\n1 0 0\n0 1 "
    "0\n3 0 1 2\n");
  convert(this->Folder / "a.ply", this->Folder / "a.vsm");
  EXPECT_FALSE(VsmReader(this->Folder / "a.vsm").info().doublePositions);
}

TEST_F(Conversion, PositionsAreRoundedWithANoteOrRefused)
{
  const std::string faces = "f 1 2 3\n";
  writeBytes(this->Folder / "round.obj", "v 0.1 0 0\nv 1 0 0\nv 0 1 0\n" + faces);
  writeBytes(this->Folder / "exact.obj", "v 0.5 0 0\nv 1 0 0\nv 0 1 0\n" + faces);
  writeBytes(this->Folder / "large.obj", "v 0 1e39 0\nv 1 0 0\nv 0 1 0\n" + faces);
  for (const char* out : { "out.sma", "out.smb" })
  {
    const ConversionReport rounded = convert(this->Folder / "round.obj", this->Folder / out);
    ASSERT_EQ(rounded.notes.size(), 1u);
    EXPECT_NE(rounded.notes[0].find("1 vertex were rounded"), std::string::npos);
    EXPECT_TRUE(convert(this->Folder / "exact.obj", this->Folder / out).notes.empty());
    std::filesystem::remove(this->Folder / out);
    const std::string message =
      messageOf([&] { convert(this->Folder / "large.obj", this->Folder / out); });
    EXPECT_NE(message.find("too large for the single precision"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(this->Folder / out));
  }
  EXPECT_TRUE(convert(this->Folder / "large.obj", this->Folder / "out.vsm").notes.empty());
}

TEST_F(Conversion, AFolderInTheWayLeavesNothing)
{
  const std::filesystem::path in = this->write(sphere(1));
  for (const char* out : { "out.vsm", "out.smb", "out.sma", "out.ply", "out.vtp", "out.vtu" })
  {
    std::filesystem::create_directory(this->Folder / out);
    EXPECT_THROW(convert(in, this->Folder / out), Error) << out;
  }
  EXPECT_EQ(this->Folder.entries(), 7);
}

TEST_F(Conversion, KindsOfInputGoByContent)
{
  const std::filesystem::path in = this->write(sphere(1));
  convert(in, this->Folder / "a.smb");
  convert(in, this->Folder / "a.vsm");
  const auto kindAs = [this](const std::filesystem::path& from, const char* name)
  {
    std::filesystem::copy_file(from, this->Folder / name);
    return kindOfInput(this->Folder / name);
  };
  EXPECT_EQ(kindAs(this->Folder / "a.smb", "smb.ply"), MeshFileKind::Stream);
  EXPECT_EQ(kindAs(this->Folder / "a.smb", "smb"), MeshFileKind::Stream);
  EXPECT_EQ(kindAs(this->Folder / "a.vsm", "vsm.smb"), MeshFileKind::Vsm);
  EXPECT_EQ(kindAs(in, "off.smb"), MeshFileKind::Indexed);
  EXPECT_EQ(kindAs(in, "off"), MeshFileKind::Indexed);
  writeBytes(this->Folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(kindOfInput(this->Folder / "a.obj"), MeshFileKind::Indexed);
  EXPECT_EQ(kindAs(this->Folder / "a.obj", "b.sma"), MeshFileKind::Stream);
  writeBytes(this->Folder / "a.txt", "nothing of the kind\n");
  EXPECT_EQ(kindOfInput(this->Folder / "a.txt"), MeshFileKind::Unknown);
  EXPECT_EQ(kindOfInput(this->Folder / "missing.smb"), MeshFileKind::Stream);
  EXPECT_EQ(kindOfInput(this->Folder / "missing"), MeshFileKind::Unknown);
  EXPECT_EQ(openMesh(this->Folder / "smb.ply")->reader().info().vertices, 42);
  EXPECT_THROW(openMesh(this->Folder / "a.txt"), Error);
}

TEST_F(Conversion, ErrorsAndCancelLeaveNothing)
{
  const std::filesystem::path in = this->write(sphere(3));
  const std::ptrdiff_t before = this->Folder.entries();
  ConversionOptions options = this->options(StreamOrder::BreadthFirst);
  options.memoryLimit = 1 << 20;
  EXPECT_THROW(convert(in, this->Folder / "out.vsm", options), Error);
  EXPECT_THROW(convert(in, this->Folder / "out.xyz"), Error);
  EXPECT_THROW(convert(in, this->Folder / "nowhere" / "out.vsm"), Error);
  EXPECT_THROW(convert(this->Folder / "missing.ply", this->Folder / "out.vsm"), Error);
  for (const char* out : { "out.vsm", "out.smb", "out.vtp" })
  {
    for (const double stop : { 0.0, 0.3, 0.5, 0.7, 0.84 })
    {
      options = this->options(StreamOrder::BreadthFirst);
      options.progress = [stop](double done) { return done <= stop; };
      EXPECT_THROW(convert(in, this->Folder / out, options), Cancelled);
    }
  }
  EXPECT_EQ(this->Folder.entries(), before);
  EXPECT_EQ(this->Scratch.entries(), 0);
}

TEST_F(Conversion, ProgressNeverGoesBack)
{
  ConversionOptions options = this->options(StreamOrder::BreadthFirst);
  double last = -1.0;
  options.progress = [&last](double done)
  {
    EXPECT_GE(done, last);
    last = done;
    return true;
  };
  convert(this->write(sphere(3)), this->Folder / "out.smb", options);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST_F(Conversion, ReportIsJson)
{
  const ConversionReport report = convert(this->write(sphere(2)), this->Folder / "out.vsm");
  const nlohmann::json json = nlohmann::json::parse(report.json());
  EXPECT_EQ(json["vertices"], 162);
  EXPECT_EQ(json["components"], 1);
  EXPECT_EQ(json["order"], "bfs");
  EXPECT_GT(json["seconds"]["total"], 0.0);
}

TEST_F(Conversion, OpenMeshConvertsWhatIsNoStreamFile)
{
  const IndexedTestMesh mesh = shuffled(sphere(3));
  const std::filesystem::path in = this->write(mesh);
  {
    const auto opened = openMesh(in, this->options(StreamOrder::BreadthFirst));
    ASSERT_TRUE(opened->conversion());
    expectSameMesh(collect(*opened->reader().source()), mesh);
    EXPECT_EQ(this->Scratch.entries(), 1);
  }
  EXPECT_EQ(this->Scratch.entries(), 0);
  convert(in, this->Folder / "a.vsm");
  const auto opened = openMesh(this->Folder / "a.vsm", this->options(StreamOrder::BreadthFirst));
  EXPECT_FALSE(opened->conversion());
  EXPECT_EQ(opened->reader().info().cells, mesh.cells());
}

TEST(ConversionData, OddScansAreCounted)
{
  const std::filesystem::path folder = archiveFolder();
  if (folder.empty())
  {
    GTEST_SKIP() << "SMG_TEST_DATA_DIR is not set";
  }
  TemporaryFolder out;
  const ConversionReport scan = convert(folder / "dragon_res3.ply", out / "out.vsm");
  EXPECT_EQ(scan.isolated_vertices, 16);
  EXPECT_EQ(scan.duplicate_cells, 1254);
  EXPECT_EQ(scan.nonmanifold_edges, 2094);
  const ConversionReport dragon = convert(folder / "dragon.ply", out / "out.vsm");
  EXPECT_EQ(dragon.components, 151);
  EXPECT_EQ(dragon.degenerate_cells, 108);
  EXPECT_EQ(dragon.boundary_edges, 4270);
}

} // namespace smg::testing
