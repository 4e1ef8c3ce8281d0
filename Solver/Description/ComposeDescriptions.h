// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/ProblemDescription.h"

#include <set>
#include <string>

namespace smg
{

/**
 * Adds what `more` says to `problem`, as later entries, which win. Of the two numbers of columns
 * the larger one counts; the weights, and the field if both have one, are those of `more`.
 */
SMG_EXPORT void append(ProblemDescription& problem, const ProblemDescription& more);

/** The names of all columns of the mesh that a description names. */
SMG_EXPORT std::set<std::string> namedColumns(const ProblemDescription& problem);

/** The names of the columns that are masks (see ColumnMask) in a description. */
SMG_EXPORT std::set<std::string> namedMasks(const ProblemDescription& problem);

/** Whether a description says anything to solve for: more than a conductivity and a screening,
 * which alone have the solution 0. */
SMG_EXPORT bool isPosed(const ProblemDescription& problem);

} // namespace smg
