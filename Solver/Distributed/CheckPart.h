// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/DistributedSolver.h"

namespace smg
{

/** Throws Error if the mesh of a part is not valid. */
void checkPart(const MeshPart& part);

} // namespace smg
