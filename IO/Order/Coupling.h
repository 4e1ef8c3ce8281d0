// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "smg/Convert.h"

namespace smg
{

/** Sets the links of a mesh: the vertices that a problem is going to couple (CoupledGroups), so
 * that its order keeps them as near each other as neighbours. Facets without a copy have none: a
 * solve says so. */
void linkCoupled(RawMesh& mesh, const CoupledGroups& coupled, Workspace& workspace);

} // namespace smg
