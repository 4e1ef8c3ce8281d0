// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/ValueRules.h"

#include "smg/CellWeights.h"

#include <algorithm>
#include <cmath>

namespace smg
{

namespace
{

/** Norms are sums of squares, which overflow for larger numbers. */
constexpr double MostMagnitude = 1e150;

} // namespace

std::array<double, 6> tensorOf(const double* numbers, int count)
{
  std::array<double, 6> tensor{ numbers[0], numbers[0], numbers[0], 0.0, 0.0, 0.0 };
  std::copy_n(numbers, count == 1 ? 0 : count, tensor.begin());
  return tensor;
}

const char* ValueRules::complaint(const double* numbers, int count) const
{
  const bool isFinite = std::all_of(numbers, numbers + count,
    [this](double number)
    { return std::isfinite(number) || (this->missing && std::isnan(number)); });
  if (isFinite && std::any_of(numbers, numbers + count,
                    [](double number) { return std::abs(number) > MostMagnitude; }))
  {
    return "must not be above 1e150 in magnitude, since its square would overflow";
  }
  switch (this->range)
  {
    case ValueRange::Any:
      return isFinite ? nullptr : "must be finite";
    case ValueRange::NotNegative:
      return isFinite && *std::min_element(numbers, numbers + count) >= 0.0
               ? nullptr
               : "must be finite and not negative";
    default:
      return isFinite && isPositiveDefinite(tensorOf(numbers, count).data())
               ? nullptr
               : "must be a positive number or a positive definite tensor";
  }
}

} // namespace smg
