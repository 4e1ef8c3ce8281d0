// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/BoundaryFacets.h"

#include "Solver/Problem/CellFacets.h"
#include "Solver/Problem/FlatCells.h"

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
    if ((flag & DuplicateCell) != 0 || hasRepeatedCorner(corner, corners))
    {
      continue;
    }
    for (int k = 0; k < corners; ++k)
    {
      const CellFacet facet = facetOf(this->Type, corner, k);
      this->Open.add(facet.vertex[0], facet.vertex[1], facet.vertex[2], 0);
    }
  }
}

} // namespace smg
