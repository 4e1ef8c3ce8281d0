// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Report.h"
#include "Solver/Problem/Assembly.h"

namespace smg
{

/** Puts what the assembly counted into the report. Throws Error if its sums overflowed. */
void reportAssembly(const Assembly& assembly, const Components& components, Report& report);

/** Adds the notes on what reportAssembly() has told. */
void addAssemblyNotes(Report& report);

} // namespace smg
