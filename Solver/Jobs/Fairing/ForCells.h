// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/FlatCells.h"
#include "smg/MeshSource.h"

#include <cstddef>
#include <cstdint>

namespace smg
{

/** Calls visit(corners) for each cell of a block that has distinct corners and is not flagged. */
template <class Visit>
void forCells(CellType type, const MeshBlock& block, Visit&& visit)
{
  const auto corners = static_cast<std::size_t>(cornersOf(type));
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < block.corners.size() / corners; ++c)
  {
    const std::int64_t* corner = block.corners.data() + c * corners;
    if (!(flags && flags->value(c) != 0.0) && !hasRepeatedCorner(corner, cornersOf(type)))
    {
      visit(corner);
    }
  }
}

} // namespace smg
