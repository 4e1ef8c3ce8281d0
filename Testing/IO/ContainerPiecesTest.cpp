// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/IO/ContainerMeshes.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

namespace smg::testing
{
namespace
{

/** Checks a piece against the whole mesh. */
void expectPiece(const MeshPiece& piece, const StreamMesh& mesh, std::int64_t first,
  std::int64_t end, const std::vector<std::int64_t>& lastCells)
{
  const int corners = cornersOf(mesh.cellType);
  std::set<std::int64_t> used(
    mesh.corners.begin() + first * corners, mesh.corners.begin() + end * corners);
  ASSERT_EQ(piece.ids, std::vector(used.begin(), used.end()));
  ASSERT_EQ(piece.firstCell, first);
  ASSERT_EQ(piece.corners.size(), std::size_t((end - first) * corners));
  std::int64_t introduced = 0;
  for (std::int64_t i = 0; i < first * corners; i++)
  {
    introduced = std::max(introduced, mesh.corners[i] + 1);
  }
  for (std::size_t i = 0; i < piece.corners.size(); i++)
  {
    ASSERT_EQ(piece.ids[piece.corners[i]], mesh.corners[first * corners + std::int64_t(i)]);
  }
  ASSERT_EQ(piece.vertexColumns.size(), mesh.vertexColumns.size());
  for (std::size_t v = 0; v < piece.ids.size(); v++)
  {
    const std::int64_t id = piece.ids[v];
    ASSERT_EQ(piece.ghost[v], id < introduced ? 1 : 0);
    ASSERT_EQ(piece.finalized[v], lastCells[id] < end ? 1 : 0);
    ASSERT_TRUE(
      std::equal(&piece.positions[3 * v], &piece.positions[3 * v] + 3, &mesh.positions[3 * id]));
    for (std::size_t c = 0; c < mesh.vertexColumns.size(); c++)
    {
      ASSERT_EQ(piece.vertexColumns[c].value(v), mesh.vertexColumns[c].value(id));
    }
  }
  ASSERT_EQ(piece.cellColumns.size(), mesh.cellColumns.size());
  for (std::size_t c = 0; c < mesh.cellColumns.size(); c++)
  {
    const std::size_t tuple = mesh.cellColumns[c].spec.tupleBytes();
    const std::span all(mesh.cellColumns[c].bytes);
    ASSERT_TRUE(std::ranges::equal(
      piece.cellColumns[c].bytes, all.subspan(first * tuple, (end - first) * tuple)));
  }
}

class ContainerPieces : public ::testing::Test
{
protected:
  TemporaryFolder Folder;
  std::filesystem::path Path = Folder / "mesh.vsm";
};

TEST_F(ContainerPieces, AreTheMesh)
{
  for (const IndexedTestMesh& mesh : { grid(120, 130, 0.1), tetBox(15, 15, 15) })
  {
    const StreamMesh stream = testStream(mesh);
    const std::vector<std::int64_t> last = lastCellsOf(stream);
    write(this->Path, stream);
    VsmReader reader(this->Path);
    MeshPiece piece;
    for (const std::int64_t count : { 1, 2, 7, 64 })
    {
      std::int64_t owned = 0;
      for (std::int64_t p = 0; p < count; p++)
      {
        const std::int64_t first = stream.cells() * p / count;
        const std::int64_t end = stream.cells() * (p + 1) / count;
        reader.readPiece(first, end, piece);
        expectPiece(piece, stream, first, end, last);
        owned += std::count(piece.ghost.begin(), piece.ghost.end(), 0);
      }
      EXPECT_EQ(owned, stream.vertices());
    }
  }
}

TEST_F(ContainerPieces, ComeInAnyOrder)
{
  const StreamMesh stream = testStream(shuffled(torus(90, 120)));
  const std::vector<std::int64_t> last = lastCellsOf(stream);
  write(this->Path, stream);
  VsmReader reader(this->Path);
  MeshPiece piece;
  Random random(5);
  for (int i = 0; i < 200; i++)
  {
    const std::int64_t first = random.below(stream.cells() + 1);
    const std::int64_t end =
      std::min(stream.cells(), first + random.below(i % 10 == 0 ? 20000 : 500));
    reader.readPiece(first, end, piece);
    expectPiece(piece, stream, first, end, last);
    reader.readPiece(first, end, piece);
    expectPiece(piece, stream, first, end, last);
  }
  expectError([&] { reader.readPiece(-1, 3, piece); }, "has no cells from -1");
  expectError([&] { reader.readPiece(0, stream.cells() + 1, piece); }, "has no cells from 0 to");
  expectError([&] { reader.readPiece(3, 2, piece); }, "has no cells from 3 to 2");
}

TEST_F(ContainerPieces, InOrderReadEveryByteOnce)
{
  write(this->Path, testStream(grid(300, 300)));
  IoStatistics statistics;
  VsmReader reader(this->Path, &statistics);
  MeshPiece piece;
  const std::int64_t cells = reader.info().cells;
  for (std::int64_t p = 0; p < 640; p++)
  {
    reader.readPiece(cells * p / 640, cells * (p + 1) / 640, piece);
  }
  EXPECT_LE(statistics.bytesRead, reader.storedBytes());
}

TEST_F(ContainerPieces, AJumpReadsOnlyTheBlocksItNeeds)
{
  write(this->Path, testStream(grid(400, 400)));
  IoStatistics statistics;
  VsmReader reader(this->Path, &statistics);
  MeshPiece piece;
  const std::int64_t before = statistics.bytesRead;
  reader.readPiece(reader.info().cells / 2, reader.info().cells / 2 + 100, piece);
  const std::int64_t blocks = reader.cellBlocks() + reader.vertexBlocks();
  EXPECT_LT((statistics.bytesRead - before) * blocks, 8 * reader.storedBytes());
}

} // namespace
} // namespace smg::testing
