// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Benchmarks/AssembledTask.h"
#include "Testing/Benchmarks/Usage.h"
#include "smg/Error.h"

#include <Eigen/CholmodSupport>

namespace smg::benchmark
{

nlohmann::json runCholmod(const Task& task)
{
  CpuClock clock;
  const testing::DirectSystem system = assemble(task);
  const double assembling = clock.lap();
  resetPeak();

  clock.lap();
  const Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<double>> factor(system.matrix);
  if (factor.info() != Eigen::Success)
  {
    throw Error("CHOLMOD could not factorise the system (out of memory or not positive definite).");
  }
  const double setUp = clock.lap();
  const Eigen::MatrixXd x = factor.solve(system.rightSide);
  const double solving = clock.lap();
  const std::int64_t peak = peakBytes();
  writeSolution(task, system.scatter(x));
  return { { "cpu_assemble", assembling }, { "cpu_setup", setUp }, { "cpu_solve", solving },
    { "cpu_total", assembling + setUp + solving }, { "peak_bytes", peak }, { "iterations", 1 },
    { "converged", true } };
}

} // namespace smg::benchmark
