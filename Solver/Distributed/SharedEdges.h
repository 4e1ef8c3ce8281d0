// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/WeightedEdges.h"
#include "Solver/Distributed/SharedVertices.h"

namespace smg
{

/** Sums the weights of the edges that several parts have: one process keeps the sum, the others
 * leave the edge out (WeightedEdges::Elsewhere). Called on all processes. */
void joinSharedEdges(const SharedVertices& vertices, WeightedEdges& edges);

} // namespace smg
