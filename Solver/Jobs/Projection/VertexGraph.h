// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The neighbours of each vertex of a part of a mesh, and walks along its edges. */
class VertexGraph
{
public:
  /** `corners` are the vertices of each cell, from 0 to `vertices` - 1; fewer than 2^31 vertices
   * and cells. */
  VertexGraph(std::span<const std::int32_t> corners, int cornersOfCell, std::int64_t vertices);

  /** Each neighbour once. */
  std::span<const std::int32_t> neighbours(std::int32_t vertex) const
  {
    const auto begin = static_cast<std::size_t>(this->Begins[vertex]);
    return std::span(this->Neighbours).subspan(begin, this->Begins[vertex + 1] - begin);
  }

  /**
   * Appends to `found` all vertices within `rings` edges of its content, nearer ones first, and
   * marks them in `isFound`, where the initial content must be marked.
   * @return the index in `found` of the first vertex at `rings` edges
   */
  std::size_t walk(
    int rings, std::vector<std::int32_t>& found, std::vector<std::uint8_t>& isFound) const;

private:
  std::vector<std::int64_t> Begins; ///< begin of each vertex, and the end
  std::vector<std::int32_t> Neighbours;
};

} // namespace smg
