// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Fairing/SweptVolume.h"

#include "Solver/Core/Vector.h"

#include <cmath>

namespace smg
{

namespace
{

/** The area vector of the triangle a + c b as a polynomial of c. */
std::array<Vector, 3> areaVector(const Vector* a, const Vector* b)
{
  const auto edge = [](const Vector* of, int k) { return difference(of[k].data(), of[0].data()); };
  const Vector mixed1 = cross(edge(a, 1), edge(b, 2));
  const Vector mixed2 = cross(edge(b, 1), edge(a, 2));
  return { scaled(0.5, cross(edge(a, 1), edge(a, 2))),
    { 0.5 * (mixed1[0] + mixed2[0]), 0.5 * (mixed1[1] + mixed2[1]), 0.5 * (mixed1[2] + mixed2[2]) },
    scaled(0.5, cross(edge(b, 1), edge(b, 2))) };
}

} // namespace

void SweptVolume::add(const double* const* x, const double* const* y, const double* const* n)
{
  Vector before[3], half[3], after[3], normal[3], halfNormal[3], still[3] = {};
  Vector move{}, direction{}; // the mean of the corners
  for (int k = 0; k < 3; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      before[k][axis] = x[k][axis];
      after[k][axis] = y[k][axis];
      half[k][axis] = 0.5 * (x[k][axis] + y[k][axis]);
      normal[k][axis] = n[k][axis];
      halfNormal[k][axis] = 0.5 * n[k][axis];
      move[axis] += (y[k][axis] - x[k][axis]) / 3.0;
      direction[axis] += n[k][axis] / 3.0;
    }
  }
  // The area vector is quadratic in time: Simpson's rule integrates it exactly.
  const std::array<Vector, 3> first = areaVector(before, still);
  const std::array<Vector, 3> middle = areaVector(half, halfNormal);
  const std::array<Vector, 3> last = areaVector(after, normal);
  for (std::size_t power = 0; power < 3; ++power)
  {
    Vector mean;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] = (first[power][axis] + 4.0 * middle[power][axis] + last[power][axis]) / 6.0;
    }
    this->Coefficients[power] += dot(move, mean);
    this->Coefficients[power + 1] += dot(direction, mean);
  }
}

double SweptVolume::at(double c) const
{
  const auto& a = this->Coefficients;
  return a[0] + c * (a[1] + c * (a[2] + c * a[3]));
}

double SweptVolume::slope(double c) const
{
  const auto& a = this->Coefficients;
  return a[1] + c * (2.0 * a[2] + c * 3.0 * a[3]);
}

std::optional<double> SweptVolume::root(double most) const
{
  constexpr int Iterations = 50;
  double c = 0.0;
  for (int i = 0; i < Iterations && this->at(c) != 0.0; ++i)
  {
    const double step = this->at(c) / this->slope(c);
    if (!(std::fabs(c - step) <= most))
    {
      return std::nullopt;
    }
    c -= step;
    if (std::fabs(step) <= 1e-12 * std::fabs(c) + 1e-15 * most)
    {
      return c;
    }
  }
  return this->at(c) == 0.0 ? std::optional(c) : std::nullopt;
}

} // namespace smg
