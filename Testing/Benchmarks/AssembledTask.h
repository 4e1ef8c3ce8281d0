// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Benchmarks/Peers.h"
#include "Testing/Support/DirectSystem.h"

namespace smg::benchmark
{

/** The task's system, assembled from the mesh file. */
testing::DirectSystem assemble(const Task& task);

/** The residual at which a solver of single columns stops: three such have that of the task. */
double goalOfColumns(const Task& task, const testing::DirectSystem& system);

/** Values of all vertices, a row each, to and from the task's solution file. */
void writeSolution(const Task& task, const Eigen::MatrixXd& values);
Eigen::MatrixXd readSolution(const Task& task, Eigen::Index vertices);

} // namespace smg::benchmark
