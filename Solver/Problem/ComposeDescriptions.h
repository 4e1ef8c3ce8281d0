// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/ProblemDescription.h"
#include "smg/Region.h"

#include <set>
#include <string>
#include <vector>

namespace smg
{

/** Appends the entries of `more` to `problem`; later entries take precedence. The number of columns
 * is the larger of the two; the weights, and the field if both have one, are those of `more`. */
SMG_EXPORT void append(ProblemDescription& problem, const ProblemDescription& more);

/** The names of all columns of the mesh that a description names. */
SMG_EXPORT std::set<std::string> namedColumns(const ProblemDescription& problem);
/** The same of parts of the mesh. */
SMG_EXPORT std::set<std::string> namedColumns(const std::vector<Where>& parts);

/** Whether a description poses a problem, that is, has data other than conductivity and screening,
 * which alone have the solution 0. */
SMG_EXPORT bool isPosed(const ProblemDescription& problem);
/** What to give a problem that is not posed, for messages. */
inline constexpr const char* PosingData =
  "dirichlet, source, flux, robin, soft, field, initial, or periodic sides with a jump";

/** The factor by which the numbers differ that a description gives as conductivities: 1 if there
 * are less than two. Columns are not known. */
SMG_EXPORT double contrastOf(const ProblemDescription& problem);

/** A text that differs if anything in the description does, for CheckpointOptions::problem. */
SMG_EXPORT std::string textOf(const ProblemDescription& problem);

} // namespace smg
