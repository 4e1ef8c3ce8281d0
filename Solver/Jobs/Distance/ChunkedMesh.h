// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/ScratchBlocks.h"
#include "Solver/Files/ScratchTraffic.h"
#include "smg/MeshSource.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace smg
{

/**
 * How a mesh is cut for a march: into chunks of consecutive vertices, each with the cells whose
 * last corner it has. A chunk is not shorter than the span of the stream, so that a cell has its
 * other corners in the same chunk or in the one before: it is *inner* or *crossing*.
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

  /** The plan for a stream whose span is known. */
  static ChunkPlan of(const StreamInfo& mesh, std::int64_t span, bool sources);

  /** Vertices of the window. */
  std::int64_t window() const { return WindowChunks * this->length; }
  /** The place of a vertex in the arrays of the window, whatever chunks that has. */
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
  ReachesOn = 16   ///< is a corner of a crossing cell of the next chunk
};

/** A mesh in chunks, with the distances so far, on scratch files. */
struct ChunkedMesh
{
  /** The blocks of a chunk in the file of the mesh ... */
  enum MeshPart
  {
    Positions,
    InnerCells,    ///< places of corners: see ChunkPlan::local()
    CrossingCells, ///< the same
    MeshParts
  };
  /** ... and in that of the distances. */
  enum StatePart
  {
    Flags,
    Distances, ///< none: all are infinite
    Sources,   ///< none: all are -1
    StateParts
  };
  struct Chunk
  {
    std::int64_t innerCells = 0, crossingCells = 0;
    std::int64_t dirty = 0; ///< number of dirty vertices
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

  ChunkPlan plan;
  ScratchBlocks mesh;  ///< block chunk * MeshParts + MeshPart
  ScratchBlocks state; ///< block chunk * StateParts + StatePart
  std::vector<Chunk> chunks;
  std::int64_t vertices = 0;
};

} // namespace smg
