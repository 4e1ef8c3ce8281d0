// SPDX-License-Identifier: BSD-3-Clause
#include "smg/Convert.h"

#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Order/Search/FileOrder.h"
#include "Solver/Memory/Pool.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

/** Two triangles; vertices 0 and 4 have no cell, 3 and 5 lie at the same place. */
constexpr const char* Ply = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\n"
                            "property float y\nproperty float z\nproperty int label\n"
                            "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                            "9 9 9 70\n0 0 0 71\n1 0 0 72\n0 1 0 73\n8 8 8 74\n0 1 0 75\n"
                            "1 1 0 76\n1 0 1 77\n3 1 2 3\n3 5 6 7\n";

class IsolatedConversion : public ::testing::Test
{
protected:
  void SetUp() override { writeBytes(this->Folder / "mesh.ply", Ply); }

  ConversionReport run(const char* in, const char* out, StreamOrder order, bool weld = false)
  {
    ConversionOptions options;
    options.order = order;
    options.scratch = this->Folder.path();
    if (weld)
    {
      options.weld = 0.0;
    }
    return convert(this->Folder / in, this->Folder / out, options);
  }

  IsolatedVertices isolated(const char* name)
  {
    VsmReader reader(this->Folder / name);
    IsolatedVertices vertices;
    reader.readIsolated(0, reader.isolatedVertices(), vertices);
    return vertices;
  }

  /** Expects these vertices of the file with their values there. */
  void expectIsolated(const char* name, const std::vector<std::int64_t>& ids)
  {
    const IsolatedVertices vertices = this->isolated(name);
    EXPECT_EQ(vertices.ids, ids);
    const auto label = findColumn(vertices.columns, { "label", ScalarType::Int32, 1 });
    const auto id = findColumn(vertices.columns, { OriginalIdName, ScalarType::Int64, 1 });
    ASSERT_GE(label, 0);
    ASSERT_GE(id, 0);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      EXPECT_EQ(vertices.columns[std::size_t(label)].value(i), 70.0 + double(ids[i]));
      EXPECT_EQ(vertices.columns[std::size_t(id)].value(i), double(ids[i]));
    }
  }

  /** The isolated vertices of the PLY file, written again in its order. */
  std::string restored(const char* name)
  {
    ConversionOptions options;
    options.restoreOrder = true;
    options.scratch = this->Folder.path();
    convert(this->Folder / name, this->Folder / "back.ply", options);
    EXPECT_EQ(this->run("back.ply", "back.vsm", StreamOrder::BreadthFirst).cells, 2);
    std::ostringstream text;
    for (const std::int64_t id : this->isolated("back.vsm").ids)
    {
      text << id << ' ';
    }
    return text.str();
  }

  TemporaryFolder Folder;
};

/** The order of first use with 2 MiB of available memory. */
OrderedVertices firstUseInLittleMemory(const RawMesh& mesh, Workspace& space)
{
  const Reservation most(space.pool(), space.available() - (std::int64_t(2) << 20));
  return firstUseOrder(mesh, space);
}

} // namespace

TEST_F(IsolatedConversion, IsolatedVerticesKeepTheirColumns)
{
  for (const StreamOrder order : { StreamOrder::BreadthFirst, StreamOrder::Keep })
  {
    EXPECT_EQ(this->run("mesh.ply", "mesh.vsm", order).isolated_vertices, 2);
    this->expectIsolated("mesh.vsm", { 0, 4 });
  }
  EXPECT_EQ(this->restored("mesh.vsm"), "0 4 ");
}

TEST_F(IsolatedConversion, AnotherOrderKeepsThem)
{
  this->run("mesh.ply", "mesh.vsm", StreamOrder::BreadthFirst);
  for (const StreamOrder order : { StreamOrder::Axis, StreamOrder::Keep })
  {
    EXPECT_EQ(this->run("mesh.vsm", "again.vsm", order).isolated_vertices, 2);
    this->expectIsolated("again.vsm", { 0, 4 });
    EXPECT_EQ(this->restored("again.vsm"), "0 4 ");
  }
}

TEST_F(IsolatedConversion, MergedPointsAreKnownByTheirPlacesInTheFirstFile)
{
  this->run("mesh.ply", "mesh.vsm", StreamOrder::Axis);
  const ConversionReport report =
    this->run("mesh.vsm", "welded.vsm", StreamOrder::BreadthFirst, true);
  EXPECT_EQ(report.merged_points, 1);
  EXPECT_EQ(report.isolated_vertices, 2);
  std::vector<std::int64_t> ids = this->isolated("welded.vsm").ids;
  std::ranges::sort(ids);
  ASSERT_EQ(ids.size(), 3U);
  const std::int64_t merged = ids[1] == 4 ? ids[2] : ids[1];
  EXPECT_TRUE(merged == 3 || merged == 5) << merged;
  EXPECT_EQ(this->restored("welded.vsm"), merged == 3 ? "0 3 4 " : "0 4 5 ");
}

TEST_F(IsolatedConversion, MoreVerticesThanTheMemoryHasBitsFor)
{
  Workspace space(this->Folder.path(), Workspace::MinMemory);
  constexpr std::int64_t Vertices = 5'000'000;
  RawMeshBuilder builder(space, CellChoice::Only);
  builder.useSinglePrecision();
  for (std::int64_t i = 0; i < Vertices; ++i)
  {
    builder.vertex(double(i), 0, 0);
  }
  builder.triangle(Vertices - 2, 0, 2'500'000);
  const RawMesh mesh = builder.finish();
  const StreamLayout layout =
    assembleStream(mesh, firstUseInLittleMemory(mesh, space), CellSequence::AsFiled, space);
  std::array<std::uint32_t, 3> corners;
  ASSERT_TRUE(RecordFile<std::uint32_t>::Reader(layout.corners).next(corners));
  EXPECT_EQ(corners, (std::array<std::uint32_t, 3>{ 0, 1, 2 }));
  const Reservation most(space.pool(), space.available() - (std::int64_t(800) << 10));
  std::int64_t next = 0;
  takeIsolatedVertices(mesh, layout, space,
    [&next](const IsolatedVertices& vertices)
    {
      for (std::size_t i = 0; i < vertices.ids.size(); ++i)
      {
        next += next == 0 || next == 2'500'000 ? 1 : 0;
        ASSERT_EQ(vertices.ids[i], next);
        ASSERT_EQ(vertices.positions[3 * i], static_cast<float>(next));
        ++next;
        next += next == Vertices - 2 ? 1 : 0;
      }
    });
  EXPECT_EQ(next, Vertices);
}

} // namespace smg::testing
