// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Elements.h"

#include "Solver/Core/Vector.h"
#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Linear finite elements on a single cell: gradients of the hat functions, measure and stiffness
// weights. The weight of an edge is the off-diagonal entry of the stiffness matrix with its sign
// changed, w_ij = -measure * grad phi_i . K grad phi_j. On a triangle with K = 1 that is half the
// cotangent of the opposite angle (Pinkall and Polthier 1993).
//
// A cell whose measure is 0 up to rounding has no weight at all: its gradients would be quotients
// of rounding errors. All results depend on the corners of one cell only, so they have the same
// bits in any block and on any thread. The cost is constant per cell.

namespace smg
{

CellGradients::CellGradients(CellType type, const double* const* points)
{
  const Vector ab = difference(points[1], points[0]);
  const Vector ac = difference(points[2], points[0]);
  if (type == CellType::Triangle)
  {
    // grad phi_1 is perpendicular to ac and has the product 1 with ab; grad phi_2 the other way
    // round. Both lie in the plane of the triangle, being perpendicular to its normal.
    const Vector normal = cross(ab, ac);
    const double inverse = 1.0 / dot(normal, normal);
    this->Gradients[1] = scaled(-inverse, cross(normal, ac));
    this->Gradients[2] = scaled(inverse, cross(normal, ab));
  }
  else
  {
    // Each gradient is perpendicular to the opposite face. The signed volume in the denominator
    // makes the result independent of the orientation of the cell.
    const Vector ad = difference(points[3], points[0]);
    const Vector b = cross(ac, ad);
    const double inverse = 1.0 / dot(ab, b);
    this->Gradients[1] = scaled(inverse, b);
    this->Gradients[2] = scaled(inverse, cross(ad, ab));
    this->Gradients[3] = scaled(inverse, cross(ab, ac));
  }
  // The hat functions sum to 1, so their gradients sum to 0. Of[3] is 0 for a triangle.
  for (std::size_t d = 0; d < 3; ++d)
  {
    this->Gradients[0][d] =
      -(this->Gradients[1][d] + this->Gradients[2][d] + this->Gradients[3][d]);
  }
}

bool hasCoincidentCorners(const double* const* corners, int count)
{
  // Relative to the longest edge: the rounding of coordinates in single precision.
  constexpr double Rounding = 1e-7;
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
  // With "<", a cell whose corners all coincide would not count.
  return shortest <= Rounding * Rounding * longest;
}

double flatnessFactor(CellType type, const double* const* corners, const CellWeights& cell)
{
  constexpr double Limit = 1e5;
  double largest = 0.0, least = 0.0;
  for (int e = 0; e < edgesOf(type); ++e)
  {
    largest = std::max(largest, std::fabs(cell.weight[e]));
    least = std::min(least, cell.weight[e]);
  }
  if (type == CellType::Triangle)
  {
    // A needle couples the two ends of its short edge and cancels nothing.
    constexpr double NeedleLimit = 1e7, Cap = 1e3;
    const double limit = -least * Cap >= Limit ? Limit : NeedleLimit;
    return largest > limit ? limit / largest : 1.0;
  }
  // The weights of a tetrahedron have the unit of length: the limit is relative to its longest
  // edge. Every edge bounds that from below, so most cells return at the first one.
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

namespace
{

/**
 * A cell is degenerate if twice its area is at most this multiple of the square of its longest
 * edge, or six times its volume of the cube of the longest edge at its first corner. Corners on a
 * line or in a plane get such measures from rounding.
 */
constexpr double Flat = 1e-14;

/** Whether K is a multiple of the identity. */
bool isScalar(const double* K)
{
  return K[0] == K[1] && K[1] == K[2] && K[3] == 0.0 && K[4] == 0.0 && K[5] == 0.0;
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
  const double inverse = 1.0 / twiceArea;
  // In this form the test also rejects NaN. The inverse overflows for cells so tiny that their area
  // is a subnormal number.
  if (!(twiceArea > Flat * scale) || !std::isfinite(inverse))
  {
    return cell;
  }
  cell.measure = 0.5 * twiceArea;
  const double half = 0.5 * inverse;
  // The cotangent of an angle is the product of the edges at its corner over twice the area. In the
  // order of TriangleEdges: the angles at c, b and a.
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
  // Twice the area vectors of the faces opposite to b, c, d and a, all outward or all inward.
  const Vector nb = cross(ac, ad);
  const Vector nc = cross(ad, ab);
  const Vector nd = cross(ab, ac);
  // The area vectors of a closed surface sum to 0.
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
  // grad phi_k = n_k / (6 V) up to a common sign, hence w = -V grad phi . grad phi = -n.n/(36V).
  const double stiffness = -1.0 / (6.0 * sixVolume);
  const Vector* n[4] = { &na, &nb, &nc, &nd };
  for (int e = 0; e < 6; ++e)
  {
    cell.weight[e] = stiffness * dot(*n[TetrahedronEdges[e][0]], *n[TetrahedronEdges[e][1]]);
  }
  return cell;
}

CellWeights conductivityWeights(CellType type, const double* const* points, const double* K)
{
  CellWeights cell = cellWeights(type, points);
  // Multiples of the identity take the formulas without a tensor: K = 1 gives the same bits as no
  // conductivity.
  if (isScalar(K))
  {
    for (double& weight : cell.weight)
    {
      weight *= K[0];
    }
    return cell;
  }
  if (cell.measure == 0.0)
  {
    return cell;
  }
  const CellGradients gradients(type, points);
  for (int e = 0; e < edgesOf(type); ++e)
  {
    const int* ends = edgeCorners(type, e);
    cell.weight[e] = -cell.measure * dot(gradients[ends[0]], product(K, gradients[ends[1]]));
  }
  return cell;
}

/** Sylvester's criterion: the leading principal minors are positive. K is divided by its largest
 * diagonal entry first, so that the products do not overflow, nor underflow for a small K. */
bool isPositiveDefinite(const double* K)
{
  const double scale = *std::max_element(K, K + 3);
  if (!(scale > 0.0) || !std::all_of(K, K + 6, [](double k) { return std::isfinite(k); }))
  {
    return false;
  }
  const double xx = K[0] / scale;
  const double yy = K[1] / scale;
  const double zz = K[2] / scale;
  const double xy = K[3] / scale;
  const double yz = K[4] / scale;
  const double xz = K[5] / scale;
  const double minor = xx * yy - xy * xy;
  const double determinant =
    xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  return xx > 0.0 && minor > 0.0 && determinant > 0.0;
}

} // namespace smg
