// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/BlockStore.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Jobs/Distance/DistanceSources.h"
#include "Solver/Jobs/Distance/NearestSource.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/**
 * How a mesh is cut for a march: into chunks of consecutive vertices, each with the cells whose
 * highest corner it contains. A chunk is at least as long as the span of the stream, so that the
 * other corners of a cell are in the same chunk (*inner* cells) or some in the one before
 * (*crossing* cells).
 */
struct ChunkPlan
{
  /** Chunks in memory at once. */
  static constexpr std::int64_t WindowChunks = 4;

  CellType cellType = CellType::Triangle;
  std::int64_t span = 0;        ///< as StreamInfo::span
  std::int64_t length = 0;      ///< vertices of a chunk; the last one may have fewer
  bool singlePositions = false; ///< whether the files have positions in single precision
  bool sources = false;         ///< whether the numbers of sources are stored
  bool directions = false;      ///< whether directions are stored
  bool arrivals = false;        ///< whether it is stored how paths arrive: PathArrival
  bool roots = false;           ///< whether it is stored where paths turn last: FrontRoot
  bool nearest = false;         ///< whether nearest sources are stored: NearestSource
  /** Distances beyond are not wanted. */
  double within = std::numeric_limits<double>::infinity();

  /** The plan for a stream whose span is known. */
  static ChunkPlan of(const StreamInfo& mesh, std::int64_t span, bool sources, bool directions);

  /** Vertices of the window. */
  std::int64_t window() const { return WindowChunks * this->length; }
  /** The place of a vertex in the arrays of the window. It does not depend on which chunks are
   * shown. */
  std::uint32_t local(std::int64_t vertex) const
  {
    return static_cast<std::uint32_t>(vertex % this->window());
  }
};

/** Bits that a vertex has in a march. */
enum VertexFlag : std::uint8_t
{
  Dirty = 1,       ///< its distance has changed, and some cell has not seen it
  Straight = 2,    ///< the front is straight; otherwise round, with the distance as its radius
  Changed = 4,     ///< differs from what the file has
  ReachesBack = 8, ///< is a corner of a crossing cell of its own chunk
  ReachesOn = 16,  ///< is a corner of a crossing cell of the next chunk
  Passed = 32,     ///< paths do not turn at it: see GeodesicMarch
  Turning = 64,    ///< paths may turn at it
  OfRegion = 128   ///< is a source of a region, or has been reached from one
};

/** A mesh in chunks, with the distances so far, on scratch files. */
struct ChunkedMesh
{
  /** The blocks of a chunk in the file of the mesh. */
  enum MeshPart
  {
    Positions,
    InnerCells,    ///< places of corners: see ChunkPlan::local()
    CrossingCells, ///< places of corners
    NearestSources,
    MeshParts
  };
  /** The blocks of a chunk in the file of the distances. */
  enum StatePart
  {
    Flags,
    Distances,  ///< a block without bytes: all are infinite
    Sources,    ///< a block without bytes: all are -1
    Directions, ///< a block without bytes: all are 0
    Arrivals,   ///< a block without bytes: none has arrived
    Roots,      ///< a block without bytes: none is known
    Fronts,     ///< MarchWindow::waiting()
    StateParts
  };
  struct Chunk
  {
    std::int64_t innerCells = 0, crossingCells = 0;
    std::int64_t dirty = 0; ///< number of dirty vertices, and of waiting intervals
  };

  ChunkedMesh(
    const ChunkPlan& chunkPlan, const std::filesystem::path& folder, ScratchTraffic& traffic)
    : plan(chunkPlan)
    , mesh(folder / "mesh", traffic.add("mesh"))
    , state(folder / "distances", traffic.add("distances"))
  {
  }

  std::int64_t firstOf(std::int64_t chunk) const { return chunk * this->plan.length; }
  std::int64_t countOf(std::int64_t chunk) const
  {
    return std::min(this->plan.length, this->vertices - this->firstOf(chunk));
  }
  std::int64_t count() const { return static_cast<std::int64_t>(this->chunks.size()); }
  /** Where an approximate march ends: some edges farther than what is wanted, since a path may
   * cross facets whose corners are farther than its end. */
  double farthest() const
  {
    constexpr double Margin = 3.0;
    return this->plan.within + Margin * this->longestEdge;
  }
  /** Reads x, y, z of the vertices of a chunk. */
  void readPositions(std::int64_t chunk, std::span<double> positions);
  std::int64_t cells() const
  {
    std::int64_t sum = 0;
    for (const Chunk& chunk : this->chunks)
    {
      sum += chunk.innerCells + chunk.crossingCells;
    }
    return sum;
  }

  ChunkPlan plan;
  BlockStore mesh;  ///< block chunk * MeshParts + MeshPart
  BlockStore state; ///< block chunk * StateParts + StatePart
  std::vector<Chunk> chunks;
  std::int64_t vertices = 0;
  double longestEdge = 0.0; ///< of the cells that take part; known if plan.within is given
};

/** Cuts a mesh stream into chunks, with the distance 0 at sources. A chunk is written when all its
 * vertices are final. */
class ChunkWriter
{
public:
  /** `facets`, if given, gets those of the sources at which paths end. */
  ChunkWriter(ChunkedMesh& to, DistanceSources& sources, SourceFacets* facets, Pool& pool);

  /** Adds the next block, which has been checked: see StreamCheck. */
  void add(const MeshBlock& block);
  /** Writes the last chunks, after the last block. */
  void finish();

  std::int64_t sources() const { return this->SourceCount; }
  std::int64_t cells() const { return this->Cells; }
  /** The number of cells that take no part: duplicates, and cells with a repeated corner. */
  std::int64_t skipped() const { return this->Skipped; }

private:
  /** Corners of cells, appended one cell after the other. */
  class CellList
  {
  public:
    void add(Pool& pool, const std::uint32_t* corners, std::size_t count);
    std::span<const std::byte> bytes() const { return this->Memory.bytes().first(this->Used); }

  private:
    Buffer Memory;
    std::size_t Used = 0;
  };
  struct OpenCells
  {
    CellList inner, crossing;
  };

  void addVertices(const MeshBlock& block);
  void addCell(const std::int64_t* corners);
  void addSourceFacets(std::span<const std::int64_t> corners);
  void noteLongestEdge(const std::int64_t* corners);
  /** Writes the first open chunk, with `count` vertices. */
  void writeChunk(std::int64_t count);
  void writePositions(std::int64_t chunk, std::int64_t first, std::int64_t count);
  void writeState(std::int64_t chunk, std::int64_t first, std::int64_t count);

  ChunkedMesh& To;
  DistanceSources& From;
  SourceFacets* Facets;
  Pool& Owner;
  Ring<double> Points;
  Ring<std::uint8_t> Marks;   ///< VertexFlag of open vertices
  Ring<std::int64_t> Numbers; ///< if wanted: of sources, -1 elsewhere
  std::deque<OpenCells> Open; ///< the cells of the chunks from the first open one on
  Buffer Row;                 ///< values of a chunk, converted for writing
  std::int64_t SourceCount = 0, Cells = 0, Skipped = 0;
};

} // namespace smg
