// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/FacetSet.h"
#include "Solver/Assembly/OpenFacets.h"
#include "Solver/Distributed/SharedVertices.h"

namespace smg
{

/** The facets with one cell in this part, but several in all parts. Called on all processes. */
FacetSet innerFacets(const SharedVertices& vertices, CellType type, const OpenFacets& facets);

} // namespace smg
