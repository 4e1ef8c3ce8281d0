// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace smg
{

/** The keys of a problem file. */
inline constexpr std::array ProblemKeys{ "weights", "columns", "conductivity", "screening",
  "source", "field", "initial", "dirichlet", "flux", "robin", "soft", "outputs" };

} // namespace smg
