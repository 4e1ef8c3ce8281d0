// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "smg/DistributedSolver.h"

namespace smg
{

/** See DistributedSolver::evaluate(). */
void evaluatePart(const SharedVertices& vertices, const MeshPart& part, Problem& problem,
  const ResultOptions& options, DistributedSolution& solution);

} // namespace smg
