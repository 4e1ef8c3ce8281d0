// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Column.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <vector>

namespace smg
{

/** Counts the values that become the smallest or largest number of the type of their column since
 * they are, rounded, beyond it: sets Report::clipped, and adds a note if there are any. The
 * components of `columns` are the columns of the solution, one after the other. */
void countClipped(Solution& solution, const std::vector<ColumnSpec>& columns, Report& report);

} // namespace smg
