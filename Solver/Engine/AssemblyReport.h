// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Problem/Assembly.h"
#include "smg/Export.h"
#include "smg/Report.h"

namespace smg
{

/** Puts what the assembly counted into the report. Throws Error if its sums overflowed. */
SMG_EXPORT void reportAssembly(
  const Assembly& assembly, const Components& components, Report& report);

/** Adds the notes on what reportAssembly() has told. */
SMG_EXPORT void addAssemblyNotes(Report& report);

} // namespace smg
