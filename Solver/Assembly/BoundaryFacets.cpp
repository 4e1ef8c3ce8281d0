// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/BoundaryFacets.h"

#include "Solver/Assembly/CellFacets.h"
#include "Solver/Assembly/FlatCells.h"

namespace smg
{

void BoundaryFacets::addCells(const MeshBlock& block)
{
  const int corners = cornersOf(this->Type);
  const std::size_t cells = block.corners.size() / static_cast<std::size_t>(corners);
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < cells; ++c)
  {
    const std::int64_t* corner = block.corners.data() + c * static_cast<std::size_t>(corners);
    const unsigned flag = flags ? static_cast<unsigned>(flags->value(c)) : 0;
    if (!isDistinctCell(corner, corners, flag))
    {
      continue;
    }
    for (int k = 0; k < corners; ++k)
    {
      const CellFacet facet = facetOf(this->Type, corner, k);
      // Of an edge: 1 if the triangle runs along it from the lower vertex, 2 if to it.
      const std::int32_t direction = (facet.order[0] == 0) != (k == 1) ? 1 : 2;
      const std::int32_t other =
        this->Open.add(facet.vertex[0], facet.vertex[1], facet.vertex[2], direction);
      if (this->Type == CellType::Triangle && other == direction)
      {
        this->MaybeTurned.emplace(facet.vertex[0], facet.vertex[1]);
      }
      else if (other == 0 && !this->MaybeTurned.empty()) // a third triangle
      {
        this->MaybeTurned.erase({ facet.vertex[0], facet.vertex[1] });
      }
    }
  }
}

} // namespace smg
