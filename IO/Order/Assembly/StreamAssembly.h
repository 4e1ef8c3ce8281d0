// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Pages/OrderedVertices.h"

#include <cstdint>

namespace smg
{

/** The order of the cells relative to that of the vertices. */
enum class CellSequence
{
  Sorted, ///< each as soon as its last vertex is reached
  AsFiled ///< as in the file; the vertices must be in the order of their first use
};

/** A cell with flags. */
struct FlaggedCell
{
  std::uint32_t cell; ///< number in the stream
  std::uint32_t flags;
};

/** A mesh as a compact stream, in scratch files. */
struct StreamLayout
{
  explicit StreamLayout(Workspace& workspace)
    : vertices(workspace)
    , corners(workspace)
    , elements(workspace)
    , flags(workspace)
    , blockVertices(workspace)
    , blockFinalized(workspace)
  {
  }

  /** Cells of a block; the last one may have fewer. */
  static constexpr std::int64_t BlockCells = 16384;

  std::int64_t vertexCount = 0;
  std::int64_t cellCount = 0;
  /** The vertices in stream order: OrderedVertex records, whose reach is not used. */
  BucketFile vertices;
  RecordFile<std::uint32_t> corners;       ///< stream indices, cornersOf(cellType) per cell
  RecordFile<std::uint32_t> elements;      ///< of the file, of each cell
  RecordFile<FlaggedCell> flags;           ///< by ascending cells
  RecordFile<std::int64_t> blockVertices;  ///< number of vertices used up to the end of each block
  RecordFile<std::int64_t> blockFinalized; ///< as MeshBlock::finalized

  std::int64_t degenerateCells = 0;
  std::int64_t duplicateCells = 0;
  std::int64_t invertedCells = 0; ///< tetrahedra of negative volume
};

/** Assembles the mesh as a stream in the order: cells by their positions, vertices by first use.
 * Vertices that no cell uses are omitted. Throws Error; Cancelled. */
StreamLayout assembleStream(
  const RawMesh& mesh, OrderedVertices order, CellSequence sequence, Workspace& workspace);

} // namespace smg
