// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/MeshSource.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace smg
{

/** The number of cells of a block. */
inline std::size_t cellsOf(CellType type, const MeshBlock& block)
{
  return block.corners.size() / static_cast<std::size_t>(cornersOf(type));
}

/** Whether a cell uses a vertex twice. */
inline bool hasRepeatedCorner(const std::int64_t* corners, int count)
{
  for (int a = 1; a < count; ++a)
  {
    if (std::find(corners, corners + a, corners[a]) != corners + a)
    {
      return true;
    }
  }
  return false;
}

/** Whether a cell with these flags (CellFlag) is no duplicate and has distinct corners. */
inline bool isDistinctCell(const std::int64_t* corners, int count, unsigned flags)
{
  return (flags & DuplicateCell) == 0 && !hasRepeatedCorner(corners, count);
}

/** Calls visit(corners, flags, c) for the cells [begin, end) of a block; `flags` are bits of
 * CellFlag. */
template <class Visit>
void forCellRange(
  CellType type, const MeshBlock& block, std::size_t begin, std::size_t end, Visit&& visit)
{
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  const Column* flags = block.flags();
  for (std::size_t c = begin; c < end; ++c)
  {
    visit(
      block.corners.data() + c * corners, flags ? static_cast<unsigned>(flags->value(c)) : 0U, c);
  }
}

/** The same for all cells of a block. */
template <class Visit>
void forAllCells(CellType type, const MeshBlock& block, Visit&& visit)
{
  forCellRange(type, block, 0, cellsOf(type, block), visit);
}

/** Calls visit(corners, c) for each cell of a block that has distinct corners and is no duplicate.
 */
template <class Visit>
void forDistinctCells(CellType type, const MeshBlock& block, Visit&& visit)
{
  forAllCells(type, block,
    [&](const std::int64_t* corners, unsigned flags, std::size_t c)
    {
      if (isDistinctCell(corners, cornersOf(type), flags))
      {
        visit(corners, c);
      }
    });
}

/** Calls visit(corners, c) for each cell of a block that has distinct corners and is not flagged.
 */
template <class Visit>
void forUnflaggedCells(CellType type, const MeshBlock& block, Visit&& visit)
{
  forAllCells(type, block,
    [&](const std::int64_t* corners, unsigned flags, std::size_t c)
    {
      if (flags == 0 && !hasRepeatedCorner(corners, cornersOf(type)))
      {
        visit(corners, c);
      }
    });
}

} // namespace smg
