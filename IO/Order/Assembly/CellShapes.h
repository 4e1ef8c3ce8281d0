// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/OrderedJobs.h"
#include "IO/Order/Assembly/CellShape.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "Solver/Memory/Reservation.h"
#include "smg/MeshSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** Writes the flags of consecutive cells to a layout, and counts these and inverted cells: on all
 * threads, in the order of the cells. */
template <int Corners>
class CellShapes
{
public:
  struct Cell
  {
    std::array<std::array<double, 3>, Corners> points;
    std::array<std::int64_t, Corners> corners;
    bool isDuplicate; ///< an earlier cell has the same corners
  };

  CellShapes(StreamLayout& layout, Workspace& workspace)
    : Layout(layout)
    , AtOnce(workspace.itemsAtOnce(ChunkBytes))
    , Reserved(workspace.pool(), this->AtOnce * ChunkBytes)
    , Chunks(
        workspace.workers(), static_cast<std::size_t>(this->AtOnce),
        [](Chunk& chunk) { examine(chunk); }, [this](const Chunk& chunk) { this->take(chunk); })
    , Filled(&this->next())
  {
  }

  /** The next cell, to be filled in. */
  Cell& add()
  {
    if (this->Filled->cells.size() == ChunkCells)
    {
      this->Chunks.submit();
      this->Filled = &this->next();
    }
    return this->Filled->cells.emplace_back();
  }

  void finish()
  {
    this->Chunks.submit();
    this->Chunks.takeAll();
  }

private:
  static constexpr std::size_t ChunkCells = 512;

  struct Chunk
  {
    std::vector<Cell> cells;
    std::vector<std::uint32_t> flags;
    std::int64_t inverted = 0;
  };
  static constexpr std::int64_t ChunkBytes =
    std::int64_t(ChunkCells * (sizeof(Cell) + sizeof(std::uint32_t)));

  static void examine(Chunk& chunk)
  {
    chunk.flags.clear();
    chunk.inverted = 0;
    for (const Cell& cell : chunk.cells)
    {
      const bool degenerate = isDegenerate(cell.corners, cell.points);
      if constexpr (Corners == 4)
      {
        chunk.inverted += !degenerate && orientedVolume(cell.points) < 0 ? 1 : 0;
      }
      chunk.flags.push_back(std::uint32_t(degenerate) * DegenerateCell |
                            std::uint32_t(cell.isDuplicate) * DuplicateCell);
    }
  }

  Chunk& next()
  {
    Chunk& chunk = this->Chunks.next();
    chunk.cells.reserve(ChunkCells);
    chunk.flags.reserve(ChunkCells);
    chunk.cells.clear();
    return chunk;
  }

  void take(const Chunk& chunk)
  {
    for (const std::uint32_t flags : chunk.flags)
    {
      if (flags != 0)
      {
        this->Layout.flags.put({ this->Taken, flags });
        this->Layout.degenerateCells += flags & DegenerateCell ? 1 : 0;
        this->Layout.duplicateCells += flags & DuplicateCell ? 1 : 0;
      }
      ++this->Taken;
    }
    this->Layout.invertedCells += chunk.inverted;
  }

  StreamLayout& Layout;
  const std::int64_t AtOnce;
  Reservation Reserved;
  OrderedJobs<Chunk> Chunks;
  Chunk* Filled;
  std::uint32_t Taken = 0; ///< cells
};

} // namespace smg
