// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/MemorySource.h"
#include "smg/Solve.h"

#include <Eigen/Core>

#include <cstring>
#include <memory>

namespace smg::testing
{

/** The solution at all vertices, one row per vertex, and the report of the solve. */
struct Solved
{
  Eigen::MatrixXd values;
  Report report;
};

/** All values of a solution, read in one call. */
inline Eigen::MatrixXd valuesOf(Solution& solution)
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor values(solution.vertices(), solution.columns());
  solution.read(0, solution.vertices(), { values.data(), static_cast<std::size_t>(values.size()) });
  return values;
}

/** Solves on the mesh of a source. */
inline Solved solveMesh(MeshSource& source, Problem& problem, const SolveOptions& options)
{
  const std::unique_ptr<Solution> solution = solve(source, problem, options);
  return { valuesOf(*solution), solution->report() };
}

/** Solves on a mesh that is read in blocks of `blockCells` cells. */
inline Solved solveMesh(const StreamMesh& mesh, Problem& problem, const SolveOptions& options = {},
  std::int64_t blockCells = 1000)
{
  MemorySource source(mesh, blockCells);
  return solveMesh(source, problem, options);
}

/** Whether two matrices are equal bit for bit. */
inline bool sameBits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

} // namespace smg::testing
