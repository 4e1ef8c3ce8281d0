// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/IndexedMesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** The cells around each vertex of a mesh with fewer than 2^32 cells. */
class VertexCells
{
public:
  explicit VertexCells(const IndexedMesh& mesh);

  /** The cells that use the vertex, in the mesh's order; one that uses it twice comes twice. */
  std::span<const std::uint32_t> around(std::int64_t vertex) const
  {
    const auto v = static_cast<std::size_t>(vertex);
    return { this->Cells.data() + this->Begin[v],
      static_cast<std::size_t>(this->Begin[v + 1] - this->Begin[v]) };
  }

private:
  std::vector<std::int64_t> Begin; ///< of each vertex in Cells, and the end
  std::vector<std::uint32_t> Cells;
};

} // namespace smg
