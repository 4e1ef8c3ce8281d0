// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "smg/Deform.h"
#include "smg/DistributedSolver.h"

namespace smg
{

/** See DistributedSolver::deform(). */
DistributedSolution deformParts(const SharedVertices& vertices, const MeshPart& part,
  Handles& handles, Weights weights, const DistributedOptions& options);

} // namespace smg
