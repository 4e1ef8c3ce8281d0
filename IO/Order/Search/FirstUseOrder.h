// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Import/RawMesh.h"
#include "IO/Order/Pages/OrderedVertices.h"

namespace smg
{

/** The vertices in the order in which the cells of the file first use them; isolated ones are left
 * out. */
OrderedVertices firstUseOrder(const RawMesh& mesh, Workspace& workspace);

} // namespace smg
