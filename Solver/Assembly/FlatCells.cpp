// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/FlatCells.h"

#include "Solver/Core/Vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace smg
{

bool hasCoincidentCorners(const double* const* corners, int count)
{
  constexpr double Rounding = 1e-7; // of coordinates in single precision
  double shortest = std::numeric_limits<double>::max(), longest = 0.0;
  for (int a = 1; a < count; ++a)
  {
    for (int b = 0; b < a; ++b)
    {
      const Vector edge = difference(corners[a], corners[b]);
      shortest = std::min(shortest, dot(edge, edge));
      longest = std::max(longest, dot(edge, edge));
    }
  }
  return shortest <= Rounding * Rounding * longest;
}

double flatnessFactor(CellType type, const double* const* corners, const CellWeights& cell)
{
  constexpr double Limit = 1e5;
  double largest = 0.0;
  for (int e = 0; e < edgesOf(type); ++e)
  {
    largest = std::max(largest, std::fabs(cell.weight[e]));
  }
  if (type == CellType::Triangle)
  {
    return largest > Limit ? Limit / largest : 1.0;
  }
  // In most cases any edge already shows that the longest one is long enough.
  double square = 0.0;
  for (const int* ends : TetrahedronEdges)
  {
    const Vector edge = difference(corners[ends[0]], corners[ends[1]]);
    square = std::max(square, dot(edge, edge));
    if (largest * largest <= Limit * Limit * square)
    {
      return 1.0;
    }
  }
  return Limit * std::sqrt(square) / largest;
}

double cotangentFloor(CellType type, const double* a, const double* b)
{
  if (type == CellType::Triangle)
  {
    return 5e-4;
  }
  const Vector ab = difference(a, b);
  return 1e-4 * std::sqrt(dot(ab, ab));
}

} // namespace smg
