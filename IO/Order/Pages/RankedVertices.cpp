// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/RankedVertices.h"

#include <algorithm>

// Which vertices of a mesh occur in a cell. The bits of all vertices may not fit into the memory;
// then one range of vertices is treated at a time, with a pass over the cells for each.

namespace smg
{

UsedVertices::UsedVertices(const RawMesh& mesh, Workspace& workspace, std::int64_t memory)
  : Mesh(mesh)
  , Range(
      (std::clamp<std::int64_t>(memory * 8, 64, std::max<std::int64_t>(mesh.vertices, 64)) + 63) /
      64 * 64)
  , First(-this->Range)
  , Bits(workspace.pool(), static_cast<std::size_t>(this->Range / 8))
{
}

void UsedVertices::load(std::uint32_t vertex)
{
  this->First = vertex / this->Range * this->Range;
  std::uint64_t* words = this->words();
  // Ranges begin at multiples of their size, so a range is loaded once if vertices are asked for in
  // order.
  std::fill_n(words, this->Range / 64, 0);
  const auto first = static_cast<std::uint32_t>(this->First);
  forEachStretch(this->Mesh.corners, 1,
    [&](std::span<const std::uint32_t> corners)
    {
      for (const std::uint32_t corner : corners)
      {
        // Unsigned: a corner below the range becomes a large number, too.
        const std::uint32_t place = corner - first;
        if (place < this->Range)
        {
          words[place / 64] |= std::uint64_t(1) << place % 64;
        }
      }
    });
}

} // namespace smg
