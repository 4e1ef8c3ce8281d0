// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vsm/WriteVsm.h"
#include "Testing/Support/MemorySource.h"
#include "Testing/Support/StreamMesh.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <span>
#include <vector>

namespace smg::testing
{
namespace
{

/** The cells [first, end) and those of so many layers around them, by comparing all with all. */
std::vector<std::int64_t> cellsAround(
  const StreamMesh& mesh, std::int64_t first, std::int64_t end, int levels)
{
  const std::int64_t size = cornersOf(mesh.cellType);
  const auto cornersOfCell = [&](std::int64_t cell)
  { return std::span(mesh.corners).subspan(cell * size, size); };
  std::set<std::int64_t> cells;
  for (std::int64_t cell = first; cell < end; ++cell)
  {
    cells.insert(cell);
  }
  for (int level = 0; level < levels; ++level)
  {
    std::set<std::int64_t> vertices;
    for (const std::int64_t cell : cells)
    {
      vertices.insert(cornersOfCell(cell).begin(), cornersOfCell(cell).end());
    }
    for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
    {
      if (std::ranges::any_of(
            cornersOfCell(cell), [&](std::int64_t v) { return vertices.contains(v); }))
      {
        cells.insert(cell);
      }
    }
  }
  return { cells.begin(), cells.end() };
}

/** Compares a piece with ghosts with the mesh and with the piece without. */
void expectGhosts(const StreamMesh& mesh, const MeshPiece& plain, const MeshPiece& piece,
  std::int64_t first, std::int64_t end, int levels)
{
  const std::vector<std::int64_t> cells = cellsAround(mesh, first, end, levels);
  const std::int64_t size = cornersOf(mesh.cellType);
  ASSERT_EQ(std::int64_t(piece.corners.size()), size * std::int64_t(cells.size()));
  ASSERT_EQ(piece.ghostCells.size(), cells.size());
  EXPECT_EQ(piece.firstCell, first);
  std::set<std::int64_t> vertices;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    ASSERT_EQ(piece.ghostCells[k], cells[k] < first || cells[k] >= end ? 1 : 0);
    for (std::int64_t c = 0; c < size; ++c)
    {
      const std::int64_t vertex = mesh.corners[cells[k] * size + c];
      ASSERT_EQ(piece.ids[piece.corners[std::int64_t(k) * size + c]], vertex);
      vertices.insert(vertex);
    }
    ASSERT_EQ(piece.cellColumns[0].value(k), mesh.cellColumns[0].value(cells[k]));
  }
  ASSERT_TRUE(std::ranges::equal(piece.ids, vertices));
  for (std::size_t v = 0; v < piece.ids.size(); ++v)
  {
    const std::int64_t id = piece.ids[v];
    ASSERT_TRUE(
      std::equal(&piece.positions[3 * v], &piece.positions[3 * v] + 3, &mesh.positions[3 * id]));
    ASSERT_EQ(piece.vertexColumns[0].value(v), mesh.vertexColumns[0].value(id));
    const auto own = std::ranges::lower_bound(plain.ids, id);
    const bool isOfPiece = own != plain.ids.end() && *own == id;
    const auto place = own - plain.ids.begin();
    ASSERT_EQ(piece.ghost[v], isOfPiece ? plain.ghost[place] : 1);
    ASSERT_EQ(piece.finalized[v], isOfPiece ? plain.finalized[place] : 0);
  }
}

class GhostCells : public ::testing::Test
{
protected:
  void expect(StreamMesh mesh)
  {
    mesh.vertexColumns = { makeColumn<std::int64_t>("v", mesh.originalIds) };
    std::vector<double> numbers(static_cast<std::size_t>(mesh.cells()));
    std::iota(numbers.begin(), numbers.end(), 0.5);
    mesh.cellColumns = { makeColumn<double>("c", numbers) };
    const std::filesystem::path path = this->Folder / "mesh.vsm";
    MemorySource source(mesh);
    writeVsm(source, path);
    VsmReader reader(path);
    for (std::int64_t pieces = 1; pieces <= 7; ++pieces)
    {
      for (int levels = 1; levels <= 3; ++levels)
      {
        for (std::int64_t p = 0; p < pieces; ++p)
        {
          const std::int64_t first = mesh.cells() * p / pieces;
          const std::int64_t end = mesh.cells() * (p + 1) / pieces;
          MeshPiece plain, piece;
          reader.readPiece(first, end, plain);
          reader.readPiece(first, end, piece, levels);
          SCOPED_TRACE(std::to_string(p) + " of " + std::to_string(pieces));
          expectGhosts(mesh, plain, piece, first, end, levels);
        }
      }
    }
  }

  TemporaryFolder Folder;
};

TEST_F(GhostCells, AreTheLayersAroundAPiece)
{
  this->expect(toStream(torus(30, 20, 0.2)));
  this->expect(toStream(shuffled(grid(21, 17, 0.1), 3)));
  this->expect(toStream(tetBox(6, 5, 4, 0.1)));
  this->expect(toStream(disjointUnion(sphere(2), sphere(1), { 3, 0, 0 })));
}

TEST_F(GhostCells, AreFoundInAnyOrderOfTheStream)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    this->expect(toStream(shuffled(sphere(2), seed), TestOrder::Keep));
    this->expect(toStream(shuffled(tetBox(4, 4, 4, 0.1), seed), TestOrder::Keep));
  }
}

/** More cells than a block of the file has, so that most blocks are not looked at. */
TEST_F(GhostCells, AreFoundInTheirBlocks)
{
  StreamMesh mesh = toStream(torus(400, 60, 0.2));
  mesh.vertexColumns = { makeColumn<std::int64_t>("v", mesh.originalIds) };
  std::vector<double> numbers(static_cast<std::size_t>(mesh.cells()), 1.0);
  mesh.cellColumns = { makeColumn<double>("c", numbers) };
  MemorySource source(mesh);
  writeVsm(source, this->Folder / "mesh.vsm");
  VsmReader reader(this->Folder / "mesh.vsm");
  ASSERT_GT(reader.cellBlocks(), 4);
  for (const auto& [first, end] : { std::pair<std::int64_t, std::int64_t>{ 0, 100 }, { 8000, 8400 },
         { 20000, 20001 }, { 30000, mesh.cells() }, { 500, 500 } })
  {
    MeshPiece plain, piece;
    reader.readPiece(first, end, plain);
    reader.readPiece(first, end, piece, 2);
    expectGhosts(mesh, plain, piece, first, end, 2);
  }
}

} // namespace
} // namespace smg::testing
