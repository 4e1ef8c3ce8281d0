// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Tasks/SolveSummary.h"

#include <cstdint>

class vtkTable;

namespace smg
{

/** Fills a table with a row for each pass of a solve: what it left and what it cost, for charts.
 * `memoryLimit` in bytes. */
void fillPasses(const SolveSummary& summary, std::int64_t memoryLimit, vtkTable& table);

/** Fills a table with the sentence that a view is to show, "" if there is nothing to say. */
void fillText(const SolveSummary& summary, vtkTable& table);

} // namespace smg
