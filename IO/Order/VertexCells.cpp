// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/VertexCells.h"

#include <numeric>

namespace smg
{

VertexCells::VertexCells(const IndexedMesh& mesh)
  : Begin(static_cast<std::size_t>(mesh.vertices()) + 1)
  , Cells(mesh.corners.size())
{
  for (const std::int64_t corner : mesh.corners)
  {
    ++this->Begin[static_cast<std::size_t>(corner)];
  }
  std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
  // Filled from behind, so that the ends turn into the beginnings.
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  for (std::size_t i = mesh.corners.size(); i-- > 0;)
  {
    std::int64_t& place = this->Begin[static_cast<std::size_t>(mesh.corners[i])];
    this->Cells[static_cast<std::size_t>(--place)] = static_cast<std::uint32_t>(i / corners);
  }
}

} // namespace smg
