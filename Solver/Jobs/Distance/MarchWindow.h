// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Vector.h"
#include "Solver/Jobs/Distance/ChunkedMesh.h"
#include "Solver/Jobs/Distance/FrontInterval.h"
#include "Solver/Jobs/Distance/FrontRoot.h"
#include "Solver/Jobs/Distance/NearestSource.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** For vertices numbered from 0, the list of the cells of each. The memory belongs to the caller.
 */
struct CellStars
{
  std::uint32_t* corners = nullptr; ///< of all cells: places in a window
  std::uint32_t* start = nullptr;   ///< where the list of each vertex begins in `list`, and the end
  std::uint32_t* list = nullptr;    ///< numbers of cells, vertex by vertex

  /** Bytes for this many vertices and corners of cells. */
  static constexpr std::int64_t bytes(std::int64_t vertices, std::int64_t corners)
  {
    return (vertices + 1 + 2 * corners) * std::int64_t(sizeof(std::uint32_t));
  }

  std::span<const std::uint32_t> of(std::uint32_t vertex) const
  {
    return { this->list + this->start[vertex], this->list + this->start[vertex + 1] };
  }

  /** Lists the cells of each vertex in ascending order by a counting sort. `numberOf(corner)`
   * converts the place of a vertex to its number. */
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
 * Consecutive chunks of a mesh in memory, at most ChunkPlan::WindowChunks. Vertices are addressed
 * by their places (ChunkPlan::local()). A chunk whose state has changed is written when another one
 * takes its memory.
 */
class MarchWindow
{
public:
  MarchWindow(ChunkedMesh& mesh, Pool& pool);

  /** The bytes of a window on chunks with at most this many inner and crossing cells. */
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

  /** The chunk of a vertex. */
  std::int64_t chunkOf(std::uint32_t vertex) const
  {
    return this->Slots[vertex / this->Length].chunk;
  }

  /** Calls visit(corners) for each cell of a vertex that has all its corners in the window: inner
   * cells of the chunk, and cells that cross to the chunk before it or after it, if that is shown.
   * A cell that crosses to the next chunk is stored with that one. Or calls visit(corners, number),
   * with a number of the cell below cellNumbers(). */
  template <int Corners>
  void forCellsOf(std::uint32_t vertex, auto visit) const
  {
    const std::uint32_t slot = vertex / this->Length;
    const std::uint32_t i = vertex - slot * this->Length;
    const std::uint32_t first = slot * (this->MostInner + this->MostCrossing);
    this->visitCells<Corners>(this->Slots[slot].inner, i, first, visit);
    const std::uint8_t flags = this->Flag[vertex];
    if ((flags & ReachesBack) != 0 && this->Slots[slot].hasPrevious)
    {
      this->visitCells<Corners>(
        this->Slots[slot].crossing, this->Span + i, first + this->MostInner, visit);
    }
    if ((flags & ReachesOn) != 0 && this->Slots[slot].hasNext)
    {
      const std::uint32_t next = (slot + 1) % static_cast<std::uint32_t>(this->Slots.size());
      this->visitCells<Corners>(this->Slots[next].crossing, i + this->Span - this->Length,
        next * (this->MostInner + this->MostCrossing) + this->MostInner, visit);
    }
  }
  /** Calls visit(corner) for the third corner of each triangle of the edge between two vertices, of
   * which one has all its cells in the window. */
  void forCornersBeside(std::uint32_t a, std::uint32_t b, auto visit) const
  {
    // From a vertex of few cells, where the other one is the hub of many.
    const bool isFirst =
      this->hasAllCellsOf(a) && (!this->hasAllCellsOf(b) || this->cellsOf(a) <= this->cellsOf(b));
    this->forCellsOf<3>(isFirst ? a : b,
      [&](const std::uint32_t* cell)
      {
        std::uint32_t corner = NoVertex;
        int found = 0;
        for (int k = 0; k < 3; ++k)
        {
          const bool isOfEdge = cell[k] == a || cell[k] == b;
          found += isOfEdge ? 1 : 0;
          corner = isOfEdge ? corner : cell[k];
        }
        if (found == 2)
        {
          visit(corner);
        }
      });
  }
  /** About the number of cells of a vertex. */
  std::size_t cellsOf(std::uint32_t vertex) const
  {
    const std::uint32_t slot = vertex / this->Length;
    return this->Slots[slot].inner.of(vertex - slot * this->Length).size();
  }
  std::int64_t cellNumbers() const
  {
    return std::int64_t(this->Slots.size()) * (this->MostInner + this->MostCrossing);
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
  // By places of vertices.
  const double* point(std::uint32_t vertex) const { return this->Point + 3 * std::size_t(vertex); }
  double* distance() const { return this->Distance; }
  std::uint8_t* flags() const { return this->Flag; }
  /** Intervals of a shown chunk that wait for cells to be shown: edges belong to the chunk of their
   * higher corner. Whoever changes them sets the flag Changed of a vertex of the chunk. */
  std::vector<FrontInterval>& waiting(std::int64_t chunk)
  {
    return this->Slots[static_cast<std::size_t>(chunk % ChunkPlan::WindowChunks)].waiting;
  }
  /** Null if they are not wanted. */
  std::int64_t* source() const { return this->Source; }
  /** A path has arrived at a vertex by way of this point of a facet, which is nearest to the vertex
   * `via`: sets the direction, if that is wanted. */
  void arrive(std::uint32_t vertex, const Vector& crossing, std::uint32_t via)
  {
    if (!this->Direction)
    {
      return;
    }
    const Vector along = difference(this->point(vertex), crossing.data());
    const double length = std::sqrt(dot(along, along));
    float* direction = this->Direction + 3 * std::size_t(vertex);
    // Coincident vertices have the same direction.
    const float* same = this->Direction + 3 * std::size_t(via);
    for (std::size_t k = 0; k < 3; ++k)
    {
      direction[k] = length > 0 ? static_cast<float>(along[k] / length) : same[k];
    }
  }
  /** What the front of a vertex shows: the number of its source. All regions are one source, and
   * all sources are where numbers are not wanted. */
  std::int64_t frontSource(std::uint32_t vertex) const
  {
    const bool isRegion = !this->Source || (this->Flag[vertex] & OfRegion) != 0;
    return isRegion ? -1 : this->Source[vertex];
  }
  /** How the path arrives, if that is wanted. */
  void arrive(std::uint32_t vertex, const PathArrival& arrival)
  {
    if (this->Arrival)
    {
      this->Arrival[vertex] = arrival;
    }
  }
  const PathArrival& arrival(std::uint32_t vertex) const { return this->Arrival[vertex]; }
  /** What a vertex sees, if that is wanted. */
  const FrontRoot& root(std::uint32_t vertex) const { return this->Root[vertex]; }
  void setRoot(std::uint32_t vertex, const FrontRoot& root)
  {
    if (this->Root)
    {
      this->Root[vertex] = root;
    }
  }
  bool hasRoots() const { return this->Root != nullptr; }
  /** The nearest source of a vertex, if that is wanted. */
  const NearestSource& nearest(std::uint32_t vertex) const { return this->Nearest[vertex]; }
  bool hasNearest() const { return this->Nearest != nullptr; }
  /** The corners of the facet across which the front came to a vertex, padded with NoVertex; all
   * NoVertex if that is not known, as after the chunk has been read again. */
  std::array<std::uint32_t, 3>* via() const { return this->Via; }
  static constexpr std::uint32_t NoVertex = 0xffffffff;

private:
  struct Slot
  {
    Buffer memory;
    CellStars inner, crossing; ///< `crossing` numbers vertices from `Span` before the chunk on
    std::vector<FrontInterval> waiting;
    std::int64_t chunk = -1;
    bool hasPrevious = false, hasNext = false; ///< whether the neighbours are shown
  };

  template <int Corners>
  static void visitCells(
    const CellStars& stars, std::uint32_t vertex, std::uint32_t firstNumber, auto& visit)
  {
    for (const std::uint32_t cell : stars.of(vertex))
    {
      const std::uint32_t* const corners = stars.corners + Corners * std::size_t(cell);
      if constexpr (requires { visit(corners, cell); })
      {
        visit(corners, firstNumber + cell);
      }
      else
      {
        visit(corners);
      }
    }
  }

  void load(Slot& slot, std::int64_t chunk);
  void loadVertices(std::int64_t chunk);
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

  std::span<float> directions(std::int64_t chunk) const
  {
    return { this->Direction + 3 * std::size_t(this->placeOf(chunk)),
      3 * static_cast<std::size_t>(this->Mesh.countOf(chunk)) };
  }

  ChunkedMesh& Mesh;
  std::uint32_t Length, Span;
  std::uint32_t MostInner = 0, MostCrossing = 0; ///< cells of a chunk
  std::array<Slot, ChunkPlan::WindowChunks> Slots;
  Buffer Memory; ///< of the vertices
  double *Point, *Distance;
  std::int64_t* Source = nullptr;
  float* Direction = nullptr;       ///< null if they are not wanted
  PathArrival* Arrival = nullptr;   ///< null if they are not wanted
  FrontRoot* Root = nullptr;        ///< null if they are not wanted
  NearestSource* Nearest = nullptr; ///< null if they are not wanted
  std::array<std::uint32_t, 3>* Via = nullptr;
  std::uint8_t* Flag;
  std::int64_t Read = 0;
  std::int64_t Shown = -1; ///< the first chunk of the position before
};

} // namespace smg
