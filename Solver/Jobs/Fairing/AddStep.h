// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Report.h"

#include <string>

namespace smg
{

/** Adds the report of a step to that of all steps: work is summed up, peaks are maxima, and what
 * describes the mesh is that of the step. `name` is that of the step, for Report::steps. */
void addStep(Report& total, const Report& step, const std::string& name);

} // namespace smg
