// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/MeshColumns.h"
#include "smg/Export.h"
#include "smg/Region.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace smg
{

class Selection;

/**
 * The vertices of the boundary, or of the cells with a tag or in a mask: found in one pass over the
 * mesh stream, and afterwards known for every vertex in any order. They are kept in an unnamed
 * scratch file, one bit a vertex, of which 64 KiB are in memory.
 */
class SMG_EXPORT SelectedVertices
{
public:
  /** `where`: OnBoundary, or a ColumnTag or ColumnMask of the cells. `name` is that of the mesh in
   * messages. Throws Error if the mesh has no such column. */
  SelectedVertices(const Where& where, const StreamInfo& mesh, const std::string& name);
  ~SelectedVertices();

  /** Adds the next block of the stream, which must have that column and, if the mesh has them, the
   * CellFlags. Throws Error if a value of a mask is not a number. */
  void add(const MeshBlock& block);
  /** To be called after the last block. Throws Error if there is no such vertex. */
  void finish();

  /** Whether a vertex, by its index in the stream, is one of them; after finish(). */
  bool contains(std::int64_t vertex) const;

private:
  MeshColumns Columns;
  std::unique_ptr<Selection> Selected;
};

} // namespace smg
