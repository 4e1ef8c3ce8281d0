// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Jobs/Distance/ChunkedMesh.h"
#include "Solver/Jobs/Distance/DistanceSources.h"
#include "Solver/Memory/Buffer.h"
#include "Solver/Memory/Ring.h"

#include <cstdint>
#include <deque>

namespace smg
{

/** Cuts a mesh stream into chunks, with the distance 0 at sources. A chunk is written when all its
 * vertices are final. */
class ChunkWriter
{
public:
  ChunkWriter(ChunkedMesh& to, DistanceSources& sources, Pool& pool);

  /** Adds the next block, which has been checked: see StreamCheck. */
  void add(const MeshBlock& block);
  /** Writes the last chunks, after the last block. */
  void finish();

  std::int64_t sources() const { return this->SourceCount; }
  std::int64_t cells() const { return this->Cells; }
  /** Cells that take no part: duplicates, and those with a repeated corner. */
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
  /** Writes the first open chunk, with `count` vertices. */
  void writeChunk(std::int64_t count);
  void writePositions(std::int64_t chunk, std::int64_t first, std::int64_t count);
  void writeState(std::int64_t chunk, std::int64_t first, std::int64_t count);

  ChunkedMesh& To;
  DistanceSources& From;
  Pool& Owner;
  Ring<double> Points;
  Ring<std::uint8_t> Marks;   ///< VertexFlag of open vertices
  Ring<std::int64_t> Numbers; ///< of sources, if wanted
  std::deque<OpenCells> Open; ///< of the chunks from the first open one on
  Buffer Row;                 ///< of values that are written
  std::int64_t SourceCount = 0, Cells = 0, Skipped = 0;
};

} // namespace smg
