// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/CellWeights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace smg
{
namespace
{

using Vector = std::array<double, 3>;

/** A cell is degenerate if its measure is below this share of what its edges allow: rounding. */
constexpr double Flat = 1e-14;

Vector difference(const double* a, const double* b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

} // namespace

CellWeights triangleWeights(const double* a, const double* b, const double* c)
{
  const Vector ab = difference(b, a);
  const Vector ac = difference(c, a);
  const Vector bc = difference(c, b);
  const Vector normal = cross(ab, ac);
  const double twiceArea = std::sqrt(dot(normal, normal));
  CellWeights cell;
  const double scale = std::max({ dot(ab, ab), dot(ac, ac), dot(bc, bc) });
  if (!(twiceArea > Flat * scale) || !std::isfinite(1.0 / twiceArea))
  {
    return cell;
  }
  cell.measure = 0.5 * twiceArea;
  const double half = 0.5 / twiceArea;
  cell.weight[0] = half * dot(ac, bc);
  cell.weight[1] = -half * dot(ab, bc);
  cell.weight[2] = half * dot(ab, ac);
  return cell;
}

CellWeights tetrahedronWeights(const double* a, const double* b, const double* c, const double* d)
{
  const Vector ab = difference(b, a);
  const Vector ac = difference(c, a);
  const Vector ad = difference(d, a);
  // Twice the area vectors of the faces opposite to b, c, d and a, all outwards or all inwards.
  const Vector nb = cross(ac, ad);
  const Vector nc = cross(ad, ab);
  const Vector nd = cross(ab, ac);
  const Vector na = { -(nb[0] + nc[0] + nd[0]), -(nb[1] + nc[1] + nd[1]),
    -(nb[2] + nc[2] + nd[2]) };
  const double sixVolume = std::fabs(dot(ab, nb));
  CellWeights cell;
  const double longest = std::sqrt(std::max({ dot(ab, ab), dot(ac, ac), dot(ad, ad) }));
  const double scale = longest * longest * longest;
  if (!(sixVolume > Flat * scale) || !std::isfinite(1.0 / sixVolume))
  {
    return cell;
  }
  cell.measure = sixVolume / 6.0;
  const double stiffness = -1.0 / (6.0 * sixVolume);
  const Vector* n[4] = { &na, &nb, &nc, &nd };
  for (int e = 0; e < 6; ++e)
  {
    cell.weight[e] = stiffness * dot(*n[TetrahedronEdges[e][0]], *n[TetrahedronEdges[e][1]]);
  }
  return cell;
}

bool limitWeights(CellType type, const double* const* corners, CellWeights& cell)
{
  constexpr double Limit = 1e5;
  double square = type == CellType::Triangle ? 1.0 : 0.0;
  double largest = 0.0;
  for (int e = 0; e < (type == CellType::Triangle ? 3 : 6); ++e)
  {
    largest = std::max(largest, std::fabs(cell.weight[e]));
    if (type == CellType::Tetrahedron)
    {
      const int* ends = TetrahedronEdges[e];
      const Vector edge = difference(corners[ends[0]], corners[ends[1]]);
      square = std::max(square, dot(edge, edge));
    }
  }
  const double limit = Limit * std::sqrt(square);
  if (!(largest > limit))
  {
    return false;
  }
  for (double& weight : cell.weight)
  {
    weight *= limit / largest;
  }
  return true;
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
