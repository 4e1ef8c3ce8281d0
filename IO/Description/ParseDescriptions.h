// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Description/JsonNode.h"
#include "smg/DeformationDescription.h"
#include "smg/Export.h"
#include "smg/ProblemDescription.h"
#include "smg/Region.h"

#include <vector>

namespace smg
{

// What smg/DescriptionFiles.h reads from files, from a part of any JSON. They throw Error with the
// place.

/** The problem of readProblemText(). */
SMG_EXPORT ProblemDescription parseProblem(
  const JsonNode& node, const ProblemDescription& defaults = {});
/** The handles of readHandleText(). */
SMG_EXPORT DeformationDescription parseDeformation(const JsonNode& node);
/** The parts of a mesh of readPlacesText(). */
SMG_EXPORT std::vector<Where> parsePlaces(const JsonNode& node);

} // namespace smg
