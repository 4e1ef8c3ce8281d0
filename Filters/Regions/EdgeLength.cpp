// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Regions/EdgeLength.h"

#include "Solver/Jobs/Projection/PointTree.h"

#include <cmath>
#include <span>

namespace smg
{

double meanEdgeLength(const MeshBlock& block, CellType cellType)
{
  const std::span<const double> positions(block.positions);
  const auto corners = static_cast<std::size_t>(cornersOf(cellType));
  double sum = 0.0;
  std::int64_t edges = 0;
  for (std::size_t cell = 0; cell < block.corners.size(); cell += corners)
  {
    const auto corner = [&](std::size_t k)
    { return positions.subspan(3 * block.corners[cell + k]).first<3>(); };
    for (std::size_t i = 1; i < corners; ++i)
    {
      for (std::size_t j = 0; j < i; ++j, ++edges)
      {
        sum += std::sqrt(PointTree::squaredDistance(corner(i), corner(j)));
      }
    }
  }
  return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

} // namespace smg
