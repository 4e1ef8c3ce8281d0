// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/SharedVertices.h"
#include "smg/DistributedSolver.h"

#include <functional>

namespace smg
{

/** See DistributedSolver::gather(). */
void gatherSolution(const SharedVertices& vertices, const DistributedSolution& solution,
  const std::function<void(Solution&)>& use);

} // namespace smg
