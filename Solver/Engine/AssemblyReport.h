// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Assembly.h"
#include "smg/Export.h"
#include "smg/Report.h"

namespace smg
{

/** Adds the counts of the assembly to the report. Throws Error if its sums overflowed. */
SMG_EXPORT void reportAssembly(
  const Assembly& assembly, const Components& components, Report& report);

/** Adds the notes on the data of reportAssembly(). */
SMG_EXPORT void addAssemblyNotes(Report& report);

} // namespace smg
