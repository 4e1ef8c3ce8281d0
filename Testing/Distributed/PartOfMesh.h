// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/DistributedSolver.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace smg::testing
{

/** Rank and number of the processes of the test. */
int rankOfTest();
int sizeOfTest();

/** The first cell of each process, and the number of all: the same share for all. */
std::vector<std::int64_t> evenCuts(std::int64_t cells, int processes);
/** The same, without a cell for every second process, beginning with process 0 or 1. */
std::vector<std::int64_t> cutsWithGaps(std::int64_t cells, int processes, int first);

/** The part of the mesh that this process has. Cells are numbered from 0. */
MeshPart partOf(const StreamMesh& mesh, const std::vector<std::int64_t>& cuts);
/** The mesh of a part, as a stream in its numbering. */
StreamMesh meshOf(const MeshPart& part);

/** The whole solution, on process 0; no rows on the others. */
Eigen::MatrixXd wholeSolution(DistributedSolver& solver, const DistributedSolution& solution);

} // namespace smg::testing
