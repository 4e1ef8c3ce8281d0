// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <cstdint>

namespace smg
{

/** Looks whether the blocks of a mesh stream follow each other and are valid. */
class StreamCheck
{
public:
  explicit StreamCheck(CellType cellType)
    : Type(cellType)
  {
  }

  /**
   * To be called with each block in turn. Throws Error if it does not continue the stream, if a
   * position is not finite, or if a cell uses a vertex that has not come yet or was declared final.
   */
  void add(const MeshBlock& block);

  /** How many vertices have come. */
  std::int64_t vertices() const { return this->Vertices; }

private:
  void addVertices(const MeshBlock& block);
  void addCells(const MeshBlock& block);

  CellType Type;
  std::int64_t Vertices = 0;
  std::int64_t Cells = 0;
  std::int64_t Final = 0; ///< no cell may use a vertex below
};

} // namespace smg
