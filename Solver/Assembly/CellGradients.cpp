// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CellGradients.h"

namespace smg
{

CellGradients::CellGradients(CellType type, const double* const* points)
{
  const Vector ab = difference(points[1], points[0]);
  const Vector ac = difference(points[2], points[0]);
  if (type == CellType::Triangle)
  {
    const Vector normal = cross(ab, ac);
    const double inverse = 1.0 / dot(normal, normal);
    this->Of[1] = scaled(-inverse, cross(normal, ac));
    this->Of[2] = scaled(inverse, cross(normal, ab));
  }
  else
  {
    const Vector ad = difference(points[3], points[0]);
    const Vector b = cross(ac, ad);
    const double inverse = 1.0 / dot(ab, b);
    this->Of[1] = scaled(inverse, b);
    this->Of[2] = scaled(inverse, cross(ad, ab));
    this->Of[3] = scaled(inverse, cross(ab, ac));
  }
  for (std::size_t d = 0; d < 3; ++d)
  {
    this->Of[0][d] = -(this->Of[1][d] + this->Of[2][d] + this->Of[3][d]);
  }
}

} // namespace smg
