// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "Solver/Problem/FacetSet.h"
#include "Solver/Problem/OpenFacets.h"

namespace smg
{

/** The facets with one cell in this part, but several in all parts. Called on all processes. */
FacetSet innerFacets(const SharedVertices& vertices, CellType type, const OpenFacets& facets);

} // namespace smg
