// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/ChunkedMesh.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace smg
{

/** The cells of each vertex, of some vertices and cells that are numbered from 0. The memory is
 * that of the caller. */
struct CellStars
{
  std::uint32_t* corners = nullptr; ///< of the cells: places in a window
  std::uint32_t* start = nullptr;   ///< of the cells of a vertex in `list`; one more than vertices
  std::uint32_t* list = nullptr;    ///< cells

  /** Bytes for so many vertices and corners of cells. */
  static constexpr std::int64_t bytes(std::int64_t vertices, std::int64_t corners)
  {
    return (vertices + 1 + 2 * corners) * std::int64_t(sizeof(std::uint32_t));
  }

  std::span<const std::uint32_t> of(std::uint32_t vertex) const
  {
    return { this->list + this->start[vertex], this->list + this->start[vertex + 1] };
  }

  /** Lists the cells, in their order; `numberOf(corner)` is the number of a vertex by its place. */
  template <int Corners>
  void build(std::int64_t vertices, std::int64_t cells, auto numberOf)
  {
    std::fill_n(this->start, vertices + 1, 0U);
    const std::int64_t all = Corners * cells;
    for (std::int64_t c = 0; c < all; ++c)
    {
      ++this->start[numberOf(this->corners[c])];
    }
    for (std::int64_t v = 0; v < vertices; ++v)
    {
      this->start[v + 1] += this->start[v];
    }
    // From the last cell to the first one, so that the ends of the lists become their starts.
    for (std::int64_t c = all - 1; c >= 0; --c)
    {
      this->list[--this->start[numberOf(this->corners[c])]] =
        static_cast<std::uint32_t>(c / Corners);
    }
  }
};

/**
 * The chunks of a mesh in memory: consecutive ones, at most ChunkPlan::WindowChunks. Vertices are
 * addressed by their places (ChunkPlan::local()). A chunk whose state has changed is written when
 * another one takes its memory.
 */
class MarchWindow
{
public:
  MarchWindow(ChunkedMesh& mesh, Pool& pool);

  /** Memory of a window on chunks of at most so many cells, inner and crossing ones. */
  static std::int64_t bytes(const ChunkPlan& plan, std::int64_t vertices, std::int64_t innerCells,
    std::int64_t crossingCells);

  /** Provides exactly the chunks [first, last]. */
  void show(std::int64_t first, std::int64_t last);
  /** Writes all changed chunks. */
  void flush();
  /** Chunks that were read so far. */
  std::int64_t chunksRead() const { return this->Read; }

  ChunkedMesh& mesh() const { return this->Mesh; }
  /** The places of the vertices of a chunk that is shown. */
  std::uint32_t placeOf(std::int64_t chunk) const
  {
    return this->Mesh.plan.local(this->Mesh.firstOf(chunk));
  }

  /** Calls visit(corners) for each cell of a vertex that is wholly in the window. */
  template <int Corners>
  void forCellsOf(std::uint32_t vertex, auto visit) const
  {
    const std::uint32_t slot = vertex / this->Length;
    const std::uint32_t i = vertex - slot * this->Length;
    this->visitCells<Corners>(this->Slots[slot].inner, i, visit);
    const std::uint8_t flags = this->Flag[vertex];
    if ((flags & ReachesBack) != 0 && this->Slots[slot].hasPrevious)
    {
      this->visitCells<Corners>(this->Slots[slot].crossing, this->Span + i, visit);
    }
    if ((flags & ReachesOn) != 0 && this->Slots[slot].hasNext)
    {
      this->visitCells<Corners>(this->Slots[(slot + 1) % this->Slots.size()].crossing,
        i + this->Span - this->Length, visit);
    }
  }
  /** Whether all cells of a vertex are in the window. */
  bool hasAllCellsOf(std::uint32_t vertex) const
  {
    const std::uint8_t flags = this->Flag[vertex];
    if ((flags & (ReachesBack | ReachesOn)) == 0)
    {
      return true;
    }
    const Slot& slot = this->Slots[vertex / this->Length];
    return ((flags & ReachesBack) == 0 || slot.hasPrevious) &&
           ((flags & ReachesOn) == 0 || slot.hasNext);
  }
  /** The corners of the inner and crossing cells of a shown chunk. */
  std::span<const std::uint32_t> innerCells(std::int64_t chunk) const;
  std::span<const std::uint32_t> crossingCells(std::int64_t chunk) const;

  // By places of vertices.
  const double* point(std::uint32_t vertex) const { return this->Point + 3 * std::size_t(vertex); }
  double* distance() const { return this->Distance; }
  std::uint8_t* flags() const { return this->Flag; }
  /** Null if they are not wanted. */
  std::int64_t* source() const { return this->Source; }
  /** The corners of the facet through which the front has come to a vertex, as far as known: not
   * since a chunk was read. */
  std::array<std::uint32_t, 3>* via() const { return this->Via; }
  static constexpr std::uint32_t NoVertex = 0xffffffff;

private:
  struct Slot
  {
    Buffer memory;
    CellStars inner, crossing; ///< the latter of the vertices from `Span` before the chunk on
    std::int64_t chunk = -1;
    bool hasPrevious = false, hasNext = false; ///< whether the neighbours are shown
  };

  template <int Corners>
  static void visitCells(const CellStars& stars, std::uint32_t vertex, auto& visit)
  {
    for (const std::uint32_t cell : stars.of(vertex))
    {
      visit(stars.corners + Corners * std::size_t(cell));
    }
  }

  void load(Slot& slot, std::int64_t chunk);
  void loadPositions(std::int64_t chunk);
  void loadCells(Slot& slot, std::int64_t chunk);
  template <int Corners>
  void buildStars(Slot& slot);
  void loadState(std::int64_t chunk);
  void write(std::int64_t chunk);
  void readAhead(std::int64_t chunk) const;
  template <class T>
  std::span<T> of(T* values, std::int64_t chunk) const
  {
    return { values + this->placeOf(chunk), static_cast<std::size_t>(this->Mesh.countOf(chunk)) };
  }

  ChunkedMesh& Mesh;
  std::uint32_t Length, Span;
  std::array<Slot, ChunkPlan::WindowChunks> Slots;
  Buffer Memory; ///< of the vertices
  double *Point, *Distance;
  std::int64_t* Source = nullptr;
  std::array<std::uint32_t, 3>* Via = nullptr;
  std::uint8_t* Flag;
  std::int64_t Read = 0;
  std::int64_t Shown = -1; ///< first chunk shown last
};

} // namespace smg
