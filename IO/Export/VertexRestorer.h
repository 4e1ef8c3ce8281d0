// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Export/ColumnRows.h"
#include "IO/Export/RestoredChunks.h"
#include "IO/External/RowSort.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace smg
{

/** Sorts vertices by their original numbers, out of core: put() all, then sort(), then next()
 * delivers them. The numbers must be 0, 1, 2 ..., one vertex each. */
class VertexRestorer
{
public:
  /** For info.vertices vertices with info.vertexColumns. Uses `memory` bytes of the workspace.
   * `name` is the name of the mesh in errors. */
  VertexRestorer(
    Workspace& workspace, std::int64_t memory, const RestoredInfo& info, std::string name);

  /** Adds vertices with these numbers. The columns begin with those of the info. Throws Error if a
   * number is out of range. */
  void put(std::span<const std::int64_t> ids, std::span<const double> positions,
    const std::vector<Column>& columns);

  /** To be called after the last put(). */
  void sort() { this->Sorted.sort(); }

  /** The next vertices; returns false at the end. Throws Error if no vertex, or more than one, has
   * a number. */
  bool next(RestoredVertices& vertices);

private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string Name;
  bool DoublePositions;
  std::size_t PositionBytes;
  ColumnRows Columns;
  std::int64_t Count;
  std::int64_t Chunk; ///< vertices delivered at once
  std::int64_t Next = 0;
  RowSort Sorted; ///< a row is a position, then the columns
};

} // namespace smg
