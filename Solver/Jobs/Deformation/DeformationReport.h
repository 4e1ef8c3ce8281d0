// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/Report.h"

namespace smg
{

/** Throws Error if the handles hold no vertex, after the assembly of the rotations. */
SMG_EXPORT void checkAnyHeld(const Report& report);

/** Throws Error if the squares of the terms of the positions overflow. */
SMG_EXPORT void checkMotions(double termSquares);

/** Adds the notes on vertices of several handles and components without held vertex. */
SMG_EXPORT void addDeformationNotes(Report& report);

} // namespace smg
