// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Random/Case.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>

namespace smg::testing
{

/** What a run gives. */
struct Result
{
  Eigen::MatrixXd values; ///< vertices of the case x columns
  Report report;
};

/** The run that all others must equal to the last bit: in core, one thread, one block. */
CaseRun plain(const CaseRun& run);

/** The options of a run, with a tolerance near rounding. */
template <class Options>
void setOptions(const CaseRun& run, Options& options)
{
  options.threads = run.threads;
  options.inCore = run.inCore;
  options.coreNodes = run.coreNodes;
  options.blockNodes = run.blockNodes;
  options.sweeps = run.sweeps;
  options.acceleration = static_cast<AccelerationKind>(run.acceleration);
  options.tolerance = 1e-11;
  options.maxCycles = 400;
}

/** Solves from memory, with what the run says of checkpoints; `memoryLimit` in bytes, 0: the
 * default. */
Result solveInMemory(const Case& given, const CaseRun& run, std::int64_t memoryLimit = 0);

/** Solves a case with this checkpoint until the process kills itself at run.cancelAt; returns if
 * the solve ends before. solveInMemory() starts it as `random_problems --killed FILE DIR`. */
void solveUntilKilled(const Case& given, const std::filesystem::path& checkpoint);

/** A mesh file of the case, converted. */
std::filesystem::path convertedFile(const Case& given, const std::filesystem::path& folder);

/** Solves by way of files, with gradients and fluxes; `result` becomes the mesh with these. */
Result solveFile(const Case& given, StreamMesh& result);

/** Solves by way of the VTK filter, which pulls the mesh in pieces; without VTK from memory. */
Result solveFilter(const Case& given);

} // namespace smg::testing
