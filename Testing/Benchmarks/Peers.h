// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Benchmarks/FixedEndsProblem.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace smg::benchmark
{

/** The input of every peer. */
struct Task
{
  std::filesystem::path mesh;     ///< a .vsm file
  std::filesystem::path solution; ///< output: 3 doubles per vertex, in stream order
  double tolerance = 1e-6;        ///< of the residual beside that of the best constant
  FixedEndsProblem::Start start = FixedEndsProblem::Start::Positions;
  int threads = 1; ///< of smg; the peers use one
};

/**
 * Each solves the task in this process and writes the solution. The result holds `cpu_assemble`,
 * `cpu_setup`, `cpu_solve` in seconds, as far as they can be separated, `cpu_total`, `peak_bytes`,
 * `iterations` (hypre and PETSc: of the three columns together). For hypre, PETSc and CHOLMOD the
 * peak is measured from the assembled matrix on, without the assembly. Results of smg also hold the
 * solver's `report`, and in `mesh_seconds` the time for reading the mesh.
 */
nlohmann::json runStreaming(const Task& task);
nlohmann::json runInCore(const Task& task);
nlohmann::json runHypre(const Task& task);
nlohmann::json runPetsc(const Task& task); ///< where PETSc was found: SMG_BENCHMARK_PETSC
nlohmann::json runCholmod(const Task& task);

/** Reads the solution back: `{"relative_residual": r}` by the independently assembled system. */
nlohmann::json checkSolution(const Task& task);

} // namespace smg::benchmark
