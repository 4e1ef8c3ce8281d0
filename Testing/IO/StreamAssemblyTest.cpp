// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Assembly/StreamAssembly.h"

#include "IO/Formats/Streams/StreamConversion.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Order/Assembly/LayoutSource.h"
#include "IO/Order/Search/FileOrder.h"
#include "Testing/Support/RawMeshReading.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "Testing/Support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace smg::testing
{
namespace
{

class StreamAssembly : public ::testing::Test
{
protected:
  /** The mesh with an isolated vertex at the end. */
  RawMesh raw(const IndexedTestMesh& mesh)
  {
    RawMeshBuilder builder(this->Space, CellChoice::Only);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    {
      builder.vertex(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    }
    builder.vertex(9, 9, 9);
    const std::size_t corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
    for (const std::int64_t* v = mesh.corners.data();
         v != mesh.corners.data() + mesh.corners.size(); v += corners)
    {
      corners == 3 ? builder.triangle(v[0], v[1], v[2])
                   : builder.tetrahedron(v[0], v[1], v[2], v[3]);
    }
    return builder.finish();
  }

  enum Places
  {
    ByNumber,
    AtRandom
  };

  /** The used vertices of the mesh at these places, with their reach. */
  OrderedVertices order(const ReadMesh& mesh, Places places)
  {
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(mesh.vertices() - 1));
    std::iota(ids.begin(), ids.end(), 0u);
    if (places == AtRandom)
    {
      std::shuffle(ids.begin(), ids.end(), std::mt19937(5));
    }
    std::vector<std::uint32_t> place(ids.size());
    for (std::uint32_t i = 0; i < ids.size(); ++i)
    {
      place[ids[i]] = i;
    }
    std::vector<std::uint32_t> reach = place;
    const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
    for (std::size_t c = 0; c < mesh.corners.size(); c += corners)
    {
      std::uint32_t most = 0;
      for (std::size_t k = 0; k < corners; ++k)
      {
        most = std::max(most, place[static_cast<std::size_t>(mesh.corners[c + k])]);
      }
      for (std::size_t k = 0; k < corners; ++k)
      {
        std::uint32_t& r = reach[static_cast<std::size_t>(mesh.corners[c + k])];
        r = std::max(r, most);
      }
    }
    OrderedVertices order(this->Space);
    for (const std::uint32_t id : ids)
    {
      OrderedVertex<double> vertex{ {}, id, reach[id] };
      std::copy_n(&mesh.positions[3 * std::size_t(id)], 3, vertex.position);
      order.records.put(0, vertex);
      ++order.count;
    }
    order.records.close();
    return order;
  }

  TemporaryFolder Folder;
  Workspace Space{ Folder.path(), Workspace::MinMemory };
};

/** The numbers of the stream's vertices in the mesh. */
std::vector<std::int64_t> idsOf(const StreamMesh& stream)
{
  const auto ids = stream.vertexColumns.at(0).as<std::int64_t>();
  return { ids.begin(), ids.end() };
}

void expectSameMesh(const StreamMesh& stream, const ReadMesh& mesh)
{
  const std::vector<std::int64_t> ids = idsOf(stream);
  ASSERT_EQ(static_cast<std::int64_t>(ids.size()), mesh.vertices() - 1);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(stream.positions[3 * i + axis], mesh.positions[3 * std::size_t(ids[i]) + axis]);
    }
  }
  ASSERT_EQ(stream.cells(), mesh.cells());
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const auto elements = stream.cellColumns.at(0).as<std::int64_t>();
  std::vector<bool> seen(elements.size());
  for (std::size_t c = 0; c < elements.size(); ++c)
  {
    ASSERT_FALSE(seen[std::size_t(elements[c])]);
    seen[std::size_t(elements[c])] = true;
    for (std::size_t k = 0; k < corners; ++k)
    {
      ASSERT_EQ(ids[std::size_t(stream.corners[c * corners + k])],
        mesh.corners[std::size_t(elements[c]) * corners + k]);
    }
  }
}

} // namespace

TEST_F(StreamAssembly, SortedCellsComeWhenTheirLastVertexIsReached)
{
  for (const IndexedTestMesh& test : { shuffled(sphere(3)), shuffled(tetBox(6, 6, 6)) })
  {
    const RawMesh mesh = this->raw(test);
    const ReadMesh read = readRaw(mesh);
    OrderedVertices order = this->order(read, AtRandom);
    std::vector<std::int64_t> place(static_cast<std::size_t>(read.vertices()));
    BucketFile::Reader records(order.records);
    OrderedVertex<double> vertex{};
    for (std::int64_t i = 0; records.get(vertex); ++i)
    {
      place[vertex.id] = i;
    }
    const StreamLayout layout =
      assembleStream(mesh, std::move(order), CellSequence::Sorted, this->Space);
    LayoutSource source(mesh, layout, this->Space);
    const StreamMesh stream = collect(source);
    expectSameMesh(stream, read);
    const std::vector<std::int64_t> ids = idsOf(stream);
    const auto corners = static_cast<std::size_t>(cornersOf(read.cellType));
    std::vector<std::int64_t> before;
    for (std::size_t c = 0; c < stream.corners.size(); c += corners)
    {
      std::vector<std::int64_t> places;
      for (std::size_t k = 0; k < corners; ++k)
      {
        places.push_back(place[std::size_t(ids[std::size_t(stream.corners[c + k])])]);
      }
      std::sort(places.rbegin(), places.rend());
      ASSERT_LT(before, places);
      before = places;
    }
  }
}

TEST_F(StreamAssembly, VerticesAreSaidToBeFinalAsSoonAsTheyAre)
{
  const RawMesh mesh = this->raw(grid(200, 200));
  const ReadMesh read = readRaw(mesh);
  const StreamLayout layout =
    assembleStream(mesh, this->order(read, ByNumber), CellSequence::Sorted, this->Space);
  LayoutSource source(mesh, layout, this->Space);
  std::vector<std::int64_t> last(static_cast<std::size_t>(read.vertices() - 1));
  std::vector<std::pair<std::int64_t, std::int64_t>> finalized; // cells so far, vertices
  std::int64_t cells = 0;
  for (MeshBlock block; source.next(block);)
  {
    for (std::size_t i = 0; i < block.corners.size(); ++i)
    {
      last[std::size_t(block.corners[i])] = cells + static_cast<std::int64_t>(i / 3);
    }
    cells += static_cast<std::int64_t>(block.corners.size() / 3);
    finalized.emplace_back(cells, block.finalized);
  }
  ASSERT_GT(finalized.size(), 3u);
  EXPECT_GT(finalized[1].second, finalized[0].second);
  EXPECT_GT(finalized[0].second, 0);
  for (const auto& [end, vertices] : finalized)
  {
    for (std::int64_t v = 0; v < vertices; ++v)
    {
      ASSERT_LT(last[std::size_t(v)], end);
    }
  }
}

TEST_F(StreamAssembly, FiledCellsKeepTheirOrder)
{
  const RawMesh mesh = this->raw(shuffled(sphere(3)));
  const ReadMesh read = readRaw(mesh);
  const StreamLayout layout =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::AsFiled, this->Space);
  LayoutSource source(mesh, layout, this->Space);
  const StreamMesh stream = collect(source);
  expectSameMesh(stream, read);
  const auto elements = stream.cellColumns.at(0).as<std::int64_t>();
  EXPECT_TRUE(std::is_sorted(elements.begin(), elements.end()));
}

TEST_F(StreamAssembly, ColumnsFollowTheirVerticesAndElements)
{
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  ImportColumn colour(builder, ColumnOf::Vertices, { "Colour", ScalarType::UInt8, 3 });
  ImportColumn label(builder, ColumnOf::Vertices, { "Label", ScalarType::Int64, 1 });
  ImportColumn part(builder, ColumnOf::Elements, { "Part", ScalarType::Int32, 1 });
  constexpr int Side = 150;
  for (int i = 0; i < Side * Side; ++i)
  {
    builder.vertex(i % Side, i / Side, 0);
    const std::array<std::uint8_t, 3> rgb{ std::uint8_t(i), std::uint8_t(i >> 8), 7 };
    const std::int64_t number = std::int64_t(i) * i;
    colour.append(std::as_bytes(std::span(rgb)));
    label.append(std::as_bytes(std::span(&number, 1)));
  }
  std::vector<int> squares((Side - 1) * (Side - 1));
  std::iota(squares.begin(), squares.end(), 0);
  std::shuffle(squares.begin(), squares.end(), std::mt19937(2));
  for (const int square : squares)
  {
    const std::int64_t a = square / (Side - 1) * Side + square % (Side - 1);
    builder.polygon(std::array<std::int64_t, 4>{ a, a + 1, a + Side + 1, a + Side });
    const std::int32_t value = square * 3;
    part.append(std::as_bytes(std::span(&value, 1)));
  }
  const RawMesh mesh = builder.finish();
  const StreamLayout layout =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::AsFiled, this->Space);
  LayoutSource source(mesh, layout, this->Space);
  const StreamMesh stream = collect(source);
  ASSERT_EQ(stream.vertexColumns.size(), 3u);
  const auto ids = stream.vertexColumns[2].as<std::int64_t>();
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ASSERT_EQ(stream.vertexColumns[0].value(i, 1), double(ids[i] >> 8 & 255));
    ASSERT_EQ(stream.vertexColumns[1].as<std::int64_t>()[i], ids[i] * ids[i]);
  }
  ASSERT_EQ(stream.cells(), 2 * (Side - 1) * (Side - 1));
  for (std::size_t c = 0; c < std::size_t(stream.cells()); ++c)
  {
    const auto element = stream.cellColumns[1].as<std::int64_t>()[c];
    ASSERT_EQ(element, std::int64_t(c / 2));
    ASSERT_EQ(stream.cellColumns[0].as<std::int32_t>()[c], 3 * squares[std::size_t(element)]);
  }
}

TEST_F(StreamAssembly, OddCellsAreFlaggedInEitherSequence)
{
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  for (int i = 0; i < 6; ++i)
  {
    builder.vertex(i % 3, i / 3, 0);
  }
  builder.triangle(0, 1, 3);
  builder.triangle(1, 4, 3);
  builder.triangle(3, 0, 1); // again
  builder.triangle(2, 2, 4); // a corner twice
  builder.triangle(0, 1, 2); // on a line
  const RawMesh mesh = builder.finish();
  const StreamLayout filed =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::AsFiled, this->Space);
  LayoutSource source(mesh, filed, this->Space);
  const StreamMesh stream = collect(source);
  EXPECT_EQ(
    stream.cellColumns.back().bytes, (std::vector<std::byte>{ {}, {}, std::byte(DuplicateCell),
                                       std::byte(DegenerateCell), std::byte(DegenerateCell) }));
  const StreamLayout sorted =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::Sorted, this->Space);
  EXPECT_EQ(sorted.degenerateCells, 2);
  EXPECT_EQ(sorted.duplicateCells, 1);
}

TEST_F(StreamAssembly, InvertedTetrahedraAreCounted)
{
  RawMeshBuilder builder(this->Space, CellChoice::Only);
  for (const std::array<double, 3>& p :
    { std::array<double, 3>{ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } })
  {
    builder.vertex(p[0], p[1], p[2]);
  }
  builder.tetrahedron(0, 1, 2, 3);
  builder.tetrahedron(1, 2, 3, 4);
  builder.tetrahedron(2, 1, 3, 4);
  const RawMesh mesh = builder.finish();
  const StreamLayout layout =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::AsFiled, this->Space);
  EXPECT_EQ(layout.invertedCells, 1);
  EXPECT_EQ(layout.duplicateCells, 1);
}

TEST_F(StreamAssembly, IsolatedVerticesAreTold)
{
  const RawMesh mesh = this->raw(shuffled(sphere(2)));
  const StreamLayout layout =
    assembleStream(mesh, firstUseOrder(mesh, this->Space), CellSequence::AsFiled, this->Space);
  std::vector<std::int64_t> ids;
  std::vector<double> positions;
  takeIsolatedVertices(mesh, layout, this->Space,
    [&](const IsolatedVertices& some)
    {
      ids.insert(ids.end(), some.ids.begin(), some.ids.end());
      positions.insert(positions.end(), some.positions.begin(), some.positions.end());
      ASSERT_EQ(some.columns.size(), 1U);
      EXPECT_EQ(some.columns[0].spec.name, OriginalIdName);
      EXPECT_TRUE(std::ranges::equal(some.columns[0].as<std::int64_t>(), some.ids));
    });
  EXPECT_EQ(ids, std::vector<std::int64_t>{ mesh.vertices - 1 });
  EXPECT_EQ(positions, (std::vector<double>{ 9, 9, 9 }));
}

TEST_F(StreamAssembly, ManyColumnsFitTheLeastMemory)
{
  Workspace space(this->Folder.path(), Workspace::MinMemory);
  RawMeshBuilder builder(space, CellChoice::Only);
  constexpr int Columns = 600;
  constexpr int Vertices = 3000;
  std::vector<ImportColumn> columns;
  for (int c = 0; c < Columns; ++c)
  {
    columns.emplace_back(
      builder, ColumnOf::Vertices, ColumnSpec{ "c" + std::to_string(c), ScalarType::Int32, 1 });
  }
  for (std::int32_t i = 0; i < Vertices; ++i)
  {
    builder.vertex(i, i % 2, 0);
    for (std::int32_t c = 0; c < Columns; ++c)
    {
      const std::int32_t value = i * Columns + c;
      columns[std::size_t(c)].append(std::as_bytes(std::span(&value, 1)));
    }
  }
  for (int i = 1; i + 2 < Vertices; ++i)
  {
    builder.triangle(i, i + 1, i + 2);
  }
  const RawMesh mesh = builder.finish();
  const StreamLayout layout =
    assembleStream(mesh, firstUseOrder(mesh, space), CellSequence::AsFiled, space);
  LayoutSource source(mesh, layout, space);
  const StreamMesh stream = collect(source);
  const auto expectValue = [](const std::vector<Column>& columns, std::size_t row, int vertex)
  {
    for (int c = 0; c < Columns; ++c)
    {
      ASSERT_EQ(columns[std::size_t(c)].as<std::int32_t>()[row], vertex * Columns + c);
    }
  };
  expectValue(stream.vertexColumns, 0, 1);
  expectValue(stream.vertexColumns, Vertices - 2, Vertices - 1);
  takeIsolatedVertices(
    mesh, layout, space, [&](const IsolatedVertices& some) { expectValue(some.columns, 0, 0); });
}

} // namespace smg::testing
