// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Assembly/OpenVertices.h"
#include "Solver/Distributed/SharedVertices.h"
#include "smg/Deform.h"
#include "smg/DistributedSolver.h"

namespace smg
{

// Vertices of several processes must be the same on each: the data of a process go into its cells
// and into the rows of others, so that what differs makes the matrix unsymmetric, or the result
// that of no problem. What rounding makes of them, 1e-6 of the largest number, is the same. Called
// on all processes; throw Error.

/** Compares the positions. */
void checkSharedPositions(const SharedVertices& vertices, const MeshPart& part);
/** Compares what the problem says of the vertices of the part. */
void checkSharedConditions(
  const SharedVertices& vertices, const MeshPart& part, const OpenVertices& given);
/** Compares where held vertices go. */
void checkSharedTargets(
  const SharedVertices& vertices, const MeshPart& part, const VertexHandles& handles);

} // namespace smg
