// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Raw/RawMesh.h"

#include <string>
#include <vector>

namespace smg
{

/**
 * A column that has the name of the original numbers, but is not of their type, as in the formats
 * that have no such integers, is one of the mesh's own: gives it a free name, and says so in a
 * sentence of `notes`.
 */
void freeNumberNames(RawMesh& mesh, std::vector<std::string>& notes);

/** Whether the mesh has columns of original numbers of its own. */
bool isNumbered(const RawMesh& mesh);

} // namespace smg
