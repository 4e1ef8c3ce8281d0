// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace smg::testing
{

inline constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr double Infinite = std::numeric_limits<double>::infinity();

} // namespace smg::testing
