// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/PagedArray.h"
#include "IO/External/Relabelling.h"
#include "IO/Order/Assembly/CellFlagger.h"
#include "IO/Order/Assembly/StreamAssembly.h"
#include "IO/Order/Pages/OrderedVertices.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace smg
{

/** The vertices that consecutive cells use. They are read from the order as far as cells reach, get
 * their stream indices by first use, and are released after their last cell. What exceeds the
 * memory is in scratch files. */
template <class Real>
class CellWindow
{
public:
  CellWindow(const OrderedVertices& order, StreamLayout& layout, Workspace& workspace)
    : Memory(share(workspace))
    , Reserved(workspace.pool(), 2 * this->Memory)
    , Records(order.records)
    , Layout(layout)
    , Slots(workspace.folder(), this->Memory)
    , Reach(workspace.folder(), this->Memory)
  {
  }

  /** Returns the stream index of the vertex at a position, which gets the next one if it has none,
   * and sets `point` to its coordinates. */
  std::uint32_t use(std::uint32_t place, std::array<double, 3>& point)
  {
    while (place >= this->Loaded)
    {
      this->load();
    }
    Slot& slot = this->Slots.at(place);
    if (slot.index == NoIndex)
    {
      slot.index = static_cast<std::uint32_t>(this->Layout.vertexCount++);
      OrderedVertex<Real> vertex{ {}, slot.id, slot.reach };
      for (int axis = 0; axis < 3; ++axis)
      {
        vertex.position[axis] = slot.position[axis];
      }
      this->Layout.vertices.put(0, vertex);
      this->Reach.at(slot.index) = slot.reach;
    }
    point = { slot.position[0], slot.position[1], slot.position[2] };
    return slot.index;
  }

  /** Declares that no further cell has a largest position of `place` or less. */
  void pass(std::uint32_t place)
  {
    while (this->Finalized < this->Layout.vertexCount && this->Reach.get(this->Finalized) <= place)
    {
      ++this->Finalized;
    }
    this->Reach.discardBelow(this->Finalized);
    while (this->Passed < this->Loaded && this->Slots.get(this->Passed).reach <= place)
    {
      ++this->Passed;
    }
    this->Slots.discardBelow(this->Passed);
  }

  /** The number of vertices, by stream index, that no further cell uses. */
  std::int64_t finalized() const { return this->Finalized; }

private:
  struct Slot
  {
    Real position[3];
    std::uint32_t id;
    std::uint32_t index;
    std::uint32_t reach;
    std::uint32_t unused[sizeof(Real) == sizeof(double) ? 7 : 2]; ///< for a size of 2^n
  };

  static std::int64_t share(Workspace& workspace)
  {
    return std::min<std::int64_t>(workspace.available() / 4, std::int64_t(64) << 20);
  }

  void load()
  {
    OrderedVertex<Real> vertex{};
    this->Records.get(vertex);
    Slot& slot = this->Slots.at(this->Loaded++);
    std::copy_n(vertex.position, 3, slot.position);
    slot.id = vertex.id;
    slot.index = NoIndex;
    slot.reach = vertex.reach;
  }

  std::int64_t Memory;
  Reservation Reserved;
  BucketFile::Reader Records;
  StreamLayout& Layout;
  PagedArray<Slot> Slots;          ///< by place
  PagedArray<std::uint32_t> Reach; ///< by stream index
  std::int64_t Loaded = 0;
  std::int64_t Finalized = 0; ///< by stream index
  std::int64_t Passed = 0;    ///< by place
};

/** Determines the flags of consecutive cells on all threads, and writes them to the layout in the
 * order of the cells. Counts flagged and inverted cells. */
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
