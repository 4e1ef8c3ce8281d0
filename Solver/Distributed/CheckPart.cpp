// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Distributed/CheckPart.h"

#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{

void checkPart(const MeshPart& part)
{
  const MeshBlock& block = part.block;
  const auto vertices = static_cast<std::int64_t>(part.ids.size());
  const auto corners = static_cast<std::size_t>(cornersOf(part.info.cellType));
  if (block.positions.size() != 3 * part.ids.size() || block.corners.size() % corners != 0 ||
      block.firstVertex != 0 || block.finalized != 0)
  {
    throw Error("a part of the mesh is not valid: it has the stream indices of " +
                std::to_string(vertices) + " vertices and " +
                std::to_string(block.positions.size()) + " coordinates");
  }
  const auto infinite = std::ranges::find_if_not(
    block.positions, [](double coordinate) { return std::isfinite(coordinate); });
  if (infinite != block.positions.end())
  {
    const auto place = static_cast<std::size_t>((infinite - block.positions.begin()) / 3);
    throw Error(
      "the position of vertex " + std::to_string(part.ids[place]) + " is not a finite number");
  }
  const auto outside = std::ranges::find_if(
    block.corners, [vertices](std::int64_t v) { return v < 0 || v >= vertices; });
  if (outside != block.corners.end())
  {
    const std::int64_t cell =
      block.firstCell + (outside - block.corners.begin()) / static_cast<std::int64_t>(corners);
    throw Error("a part of the mesh is not valid: cell " + std::to_string(cell) +
                " uses a vertex that the part does not have");
  }
}

} // namespace smg
