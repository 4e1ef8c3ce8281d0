// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include "smg/ProblemDescription.h"

#include <string>

namespace smg
{

/** A text that is another one if anything in the description is, for CheckpointOptions::problem. */
SMG_EXPORT std::string textOf(const ProblemDescription& problem);

} // namespace smg
