// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Solver/EllipticTesting.h"

#include <cmath>
#include <functional>

namespace smg::testing
{

/** Right-hand sides of the problems of the tests. */
inline constexpr int WaveColumns = 2;

/** A value at each point for column k. */
inline double wave(const Point& p, int k)
{
  return std::sin(0.7 * p[0] + k) + 0.3 * std::cos(p[1] - 0.5 * p[2]);
}

/** Sets the data of a problem. */
using Setting = std::function<void(ElementProblem&)>;

} // namespace smg::testing
