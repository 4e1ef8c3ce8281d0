// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Order/Pages/PageSize.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

constexpr int LeastVertices = 64;
constexpr std::int64_t DirectoryBytes = 32; ///< of a page, always in memory

/** Measured bytes of the pages at the front of a search, with some reserve. */
double frontierBytes(
  bool triangles, bool doublePositions, std::int64_t vertices, double pageVertices)
{
  constexpr double reserve = 1.5;
  const double count = double(vertices), positions = doublePositions ? 12 : 0;
  if (triangles)
  {
    const double queue = 5 * std::sqrt(count);
    return reserve * 1.35 * queue * std::sqrt(pageVertices) * (30 + positions);
  }
  const double queue = 2 * std::cbrt(count * count);
  return reserve * 2.1 * queue * std::cbrt(pageVertices) * (42 + positions);
}

} // namespace

int choosePageVertices(
  CellType cellType, bool doublePositions, std::int64_t vertices, std::int64_t memory)
{
  const bool triangles = cellType == CellType::Triangle;
  const double cache = double(memory) / 2;
  int pageVertices = triangles ? 512 : 256;
  while (pageVertices > LeastVertices &&
         frontierBytes(triangles, doublePositions, vertices, pageVertices) > cache)
  {
    pageVertices /= 2;
  }
  while (vertices / pageVertices * DirectoryBytes > memory / 8 && pageVertices < (1 << 20))
  {
    pageVertices *= 2;
  }
  return pageVertices;
}

double mostCrossing(CellType cellType, int pageVertices)
{
  const double border =
    cellType == CellType::Triangle ? 8 / std::sqrt(pageVertices) : 3.2 / std::cbrt(pageVertices);
  return std::min(border, 0.8);
}

} // namespace smg
