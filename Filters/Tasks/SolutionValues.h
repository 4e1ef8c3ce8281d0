// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Solve.h"

#include <cstdint>
#include <span>

namespace smg
{

/**
 * Reads the values of the vertices `ids`, in any order, to `values` (solution.columns() each), in
 * few calls in ascending order of the solution. Throws Error if an id is not one of its vertices.
 */
void readValues(Solution& solution, std::span<const std::int64_t> ids, std::span<double> values);

} // namespace smg
