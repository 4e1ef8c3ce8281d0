// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Python/C/CInterface.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>

// The blocks of a mesh or a field: together they are the whole, and each is as small as was asked
// for.

namespace smg::testing
{
namespace
{

/** An array of the block, packed. */
template <class T>
std::vector<T> packed(const smg_array& array)
{
  EXPECT_EQ(array.type, static_cast<smg_type>(scalarTypeOf<T>()));
  EXPECT_EQ(array.row_stride, array.columns * static_cast<std::int64_t>(sizeof(T)));
  std::vector<T> values(static_cast<std::size_t>(array.rows * array.columns));
  if (!values.empty())
  {
    std::memcpy(values.data(), array.data, values.size() * sizeof(T));
  }
  return values;
}

template <class T>
std::vector<T> arrayIn(smg_blocks* blocks, const char* name, bool ofCells)
{
  smg_array array{};
  expectOk(smg_block_array(blocks, name, ofCells ? 1 : 0, &array));
  return packed<T>(array);
}

std::vector<std::int64_t> rowsIn(smg_blocks* blocks, bool ofCells)
{
  smg_array array{};
  expectOk(smg_block_rows(blocks, ofCells ? 1 : 0, &array));
  return packed<std::int64_t>(array);
}

std::vector<std::uint8_t> ghostsIn(smg_blocks* blocks)
{
  smg_array array{};
  expectOk(smg_block_ghosts(blocks, &array));
  return packed<std::uint8_t>(array);
}

/** What all blocks have together, by original numbers. */
struct Union
{
  std::vector<double> positions, value;
  std::vector<std::int64_t> corners;
  std::int64_t blocks = 0, largest = 0;
};

Union unionOf(const BlocksHandle& blocks, const IndexedTestMesh& mesh, const char* column)
{
  constexpr double None = std::numeric_limits<double>::infinity();
  Union all;
  all.positions.assign(mesh.positions.size(), None);
  all.value.assign(static_cast<std::size_t>(mesh.vertices()), None);
  all.corners.assign(mesh.corners.size(), -1);
  const auto count = static_cast<std::size_t>(cornersOf(mesh.cellType));
  std::set<std::int64_t> seen;
  for (;; ++all.blocks)
  {
    std::int64_t vertices = 0, cells = 0;
    expectOk(smg_next_block(blocks.get(), &vertices, &cells));
    if (cells == 0)
    {
      return all;
    }
    all.largest = std::max(all.largest, vertices);
    const auto ids = rowsIn(blocks.get(), false);
    const auto ghosts = ghostsIn(blocks.get());
    const auto positions = arrayIn<double>(blocks.get(), "Position", false);
    const auto values = arrayIn<double>(blocks.get(), column, false);
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(vertices));
    for (std::size_t v = 0; v < ids.size(); ++v)
    {
      const auto row = static_cast<std::size_t>(ids[v]);
      EXPECT_EQ(ghosts[v] != 0, !seen.insert(ids[v]).second);
      EXPECT_TRUE(ghosts[v] == 0 || all.value[row] == values[v]);
      std::copy_n(&positions[3 * v], 3, &all.positions[3 * row]);
      all.value[row] = values[v];
    }
    const auto cellIds = rowsIn(blocks.get(), true);
    const auto corners = arrayIn<std::int64_t>(blocks.get(), "Corners", true);
    EXPECT_EQ(cellIds.size(), static_cast<std::size_t>(cells));
    for (std::size_t c = 0; c < cellIds.size(); ++c)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        all.corners[static_cast<std::size_t>(cellIds[c]) * count + k] =
          ids.at(static_cast<std::size_t>(corners[c * count + k]));
      }
    }
  }
}

BlocksHandle blocksOf(smg_mesh* mesh, smg_field* field, const std::string& options)
{
  smg_blocks* blocks = nullptr;
  expectOk(smg_open_blocks(mesh, field, options.c_str(), nullptr, nullptr, &blocks));
  return BlocksHandle(blocks);
}

TEST(CBlocks, TogetherAreTheMeshAndKeepTheirPromise)
{
  for (const IndexedTestMesh& mesh :
    { shuffled(torus(60, 40, 0.1)), shuffled(tetBox(12, 11, 10, 0.1)) })
  {
    std::vector<double> value;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      value.push_back(static_cast<double>(v * v));
    }
    const MeshHandle handle = openMesh(mesh);
    const smg_array values = arrayOf(value);
    expectOk(smg_add_column(handle.get(), "value", 0, &values, nullptr, nullptr));
    for (const std::int64_t points : { 4, 100, 731, 1000000 })
    {
      const Union all =
        unionOf(blocksOf(handle.get(), nullptr, R"({"points": )" + std::to_string(points) + "}"),
          mesh, "value");
      EXPECT_LE(all.largest, points);
      EXPECT_EQ(all.positions, mesh.positions);
      EXPECT_EQ(all.corners, mesh.corners);
      EXPECT_EQ(all.value, value);
      EXPECT_TRUE(points < mesh.vertices() || all.blocks == 1);
    }
  }
}

TEST(CBlocks, OfAFieldHaveItsResultAndOutliveIt)
{
  const IndexedTestMesh mesh = shuffled(torus(60, 40, 0.1));
  MeshHandle handle = openMesh(mesh);
  FieldHandle field = run(handle.get(), "solve",
    R"({"problem": {"outputs": ["gradient"], "dirichlet":
        [{"vertices": [0], "value": 0}, {"vertices": [9], "value": 1}]}})");
  const std::vector<double> solution =
    read<double>(nullptr, field.get(), "Solution", false, 1, mesh.vertices());
  const BlocksHandle blocks = blocksOf(nullptr, field.get(), R"({"points": 500})");
  field.reset();
  handle.reset();
  std::int64_t vertices = 0, cells = 0;
  const Union all = unionOf(blocks, mesh, "Solution");
  EXPECT_GT(all.blocks, 3);
  EXPECT_EQ(all.value, solution);
  EXPECT_EQ(all.corners, mesh.corners);
  expectOk(smg_next_block(blocks.get(), &vertices, &cells));
  EXPECT_EQ(cells, 0);
}

TEST(CBlocks, OfMovedVerticesHaveTheNewPositions)
{
  const IndexedTestMesh mesh = shuffled(sphere(3));
  const MeshHandle handle = openMesh(mesh);
  const FieldHandle field = run(handle.get(), "smooth", R"({"size": "5edges"})");
  const std::vector<double> moved =
    read<double>(nullptr, field.get(), "Position", false, 3, mesh.vertices());
  EXPECT_NE(moved, mesh.positions);
  const BlocksHandle blocks = blocksOf(nullptr, field.get(), R"({"columns": []})");
  std::int64_t vertices = 0, cells = 0;
  expectOk(smg_next_block(blocks.get(), &vertices, &cells));
  const auto ids = rowsIn(blocks.get(), false);
  const auto positions = arrayIn<double>(blocks.get(), "Position", false);
  for (std::size_t v = 0; v < ids.size(); ++v)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_EQ(positions[3 * v + k], moved[static_cast<std::size_t>(3 * ids[v]) + k]);
    }
  }
}

TEST(CBlocks, AColumnIsWhatItIsElsewhere)
{
  // The numbers of another mesh are no rows of this one, and no name but Position means something.
  const IndexedTestMesh mesh = shuffled(sphere(3));
  const TemporaryFolder folder;
  const std::string small = (folder / "small.vsm").string();
  const MeshHandle handle = openMesh(mesh);
  expectOk(
    smg_simplify(handle.get(), R"({"vertices": 100})", small.c_str(), nullptr, nullptr, nullptr));
  const MeshHandle simple = openFile(small);
  const std::int64_t count = Counts(simple.get()).vertices;
  const std::vector<float> ghost(static_cast<std::size_t>(count), 0.5F);
  const smg_array ghosts = arrayOf(ghost);
  expectOk(smg_add_column(simple.get(), "Ghost", 0, &ghosts, nullptr, nullptr));
  const auto whole = read<std::int64_t>(simple.get(), nullptr, "OriginalId", false, 1, count);
  const BlocksHandle blocks = blocksOf(simple.get(), nullptr, R"({"points": 60})");
  std::int64_t vertices = 0, cells = 0;
  expectOk(smg_next_block(blocks.get(), &vertices, &cells));
  const auto rows = rowsIn(blocks.get(), false);
  const auto ids = arrayIn<std::int64_t>(blocks.get(), "OriginalId", false);
  EXPECT_NE(ids, rows);
  for (std::size_t v = 0; v < rows.size(); ++v)
  {
    EXPECT_EQ(ids[v], whole[static_cast<std::size_t>(rows[v])]);
  }
  EXPECT_EQ(arrayIn<float>(blocks.get(), "Ghost", false), std::vector<float>(rows.size(), 0.5F));
}

} // namespace
} // namespace smg::testing
