// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/MeshSource.h"
#include "smg/Report.h"

#include <cstdint>
#include <string>
#include <utility>

namespace smg
{

/** Checks that the blocks of a mesh stream are consecutive and valid. */
class SMG_EXPORT StreamCheck
{
public:
  /** `firstCell`: the first cell of the first block, which is not 0 for a part of a mesh. */
  explicit StreamCheck(CellType cellType, std::int64_t firstCell = 0)
    : Type(cellType)
    , Cells(firstCell)
  {
  }

  /** To be called with each block in order. Throws Error if the block does not continue the stream,
   * a position is not finite, a cell uses a vertex that has not been read or was declared final,
   * or `finalized` decreases. */
  void add(const MeshBlock& block);

  /** To be called after the last block: throws Error if the stream ended before the counts that
   * `info` states. */
  void finish(const StreamInfo& info) const;

  /** The number of vertices so far. */
  std::int64_t vertices() const { return this->Vertices; }
  /** The number of cells so far. */
  std::int64_t cells() const { return this->Cells; }

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);

  CellType Type;
  std::int64_t Vertices = 0;
  std::int64_t Cells;
  std::int64_t Final = 0; ///< no cell may use a vertex below this one
};

/** How points that lie together become one, at the end of sentences, for all interfaces. Those of
 * ParaView and Python show their own part of it. */
inline constexpr const char* HowToWeld =
  "(option --weld 0; in ParaView Clean or Clean to Grid, or Weld of the Streaming Mesh Converter; "
  "in C++ ConversionOptions::weld)";

/** A note on a mesh with these counts if at least half of its cells must be bodies of their own: a
 * body of m triangles that share edges has at most m + 2 vertices, one of m tetrahedra that share
 * faces at most m + 3. Empty if that is not so, or the mesh has few cells. */
SMG_EXPORT std::string unweldedNote(CellType type, std::int64_t vertices, std::int64_t cells);

/** Adds that note to the report, if there is one. */
SMG_EXPORT void noteUnwelded(
  CellType type, std::int64_t vertices, std::int64_t cells, Report& report);

/** Checks each block of the stream and then calls `visit` with it. `isPart`: the stream is a part
 * of a mesh, which may begin with any cell. Returns the check of all blocks; the caller may call
 * its finish(). */
StreamCheck forCheckedBlocks(MeshSource& mesh, auto visit, bool isPart = false)
{
  StreamCheck check(mesh.info().cellType);
  MeshBlock block;
  for (bool isFirst = true; mesh.next(block); isFirst = false)
  {
    if (isFirst && isPart)
    {
      check = StreamCheck(mesh.info().cellType, block.firstCell);
    }
    check.add(block);
    visit(std::as_const(block));
  }
  return check;
}

} // namespace smg
