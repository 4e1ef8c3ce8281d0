// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"

#include <string>
#include <vector>

namespace smg
{

/** Renames a column of the mesh that has the name of the original indices but another type (as in
 * formats without such integers), with a sentence in `notes`. */
void freeNumberNames(RawMesh& mesh, std::vector<std::string>& notes);

/** Whether the mesh already has columns of original indices. */
bool isNumbered(const RawMesh& mesh);

} // namespace smg
