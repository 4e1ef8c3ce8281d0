// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Fuzzing/Finding.h"
#include "Testing/Fuzzing/FuzzPlace.h"
#include "smg/Solve.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace smg::testing
{

/** Two V-cycles, with small levels on disk, in the least memory. Options is SolveOptions or
 * DeformOptions. */
template <class Options = SolveOptions>
Options smallSolve()
{
  Options options;
  options.maxCycles = 2;
  options.coreNodes = 20;
  options.blockNodes = 50;
  options.threads = 1;
  options.memoryLimit = Workspace::MinMemory;
  options.scratch = FuzzPlace::instance().workspace().folder();
  return options;
}

/** All values of a solution. */
inline std::vector<double> valuesOf(Solution& solution)
{
  std::vector<double> values(static_cast<std::size_t>(solution.vertices() * solution.columns()));
  solution.read(0, solution.vertices(), values);
  return values;
}

/** What values that are not finite stand for. */
enum class Missing
{
  None,
  Undetermined, ///< NaN: what nothing determines, as the report counts it
  Unreached     ///< infinity
};

/** Throws Finding unless the memory was within the limit and only such values are not finite. */
inline void checkSolution(Solution& solution, Missing missing = Missing::None)
{
  const Report& report = solution.report();
  mustHold(report.pool_bytes_peak <= Workspace::MinMemory, "more memory was used than the limit");
  const std::vector<double> values = valuesOf(solution);
  const auto count = [&](auto&& which) { return std::ranges::count_if(values, which); };
  mustHold(count([](double value) { return std::isnan(value); }) ==
             (missing == Missing::Undetermined ? report.held * solution.columns() : 0),
    "a value of the solution is not a number, or one that nothing determines is");
  mustHold(
    missing == Missing::Unreached || count([](double value) { return std::isinf(value); }) == 0,
    "a value of the solution is infinite");
}

/** Calls compute(), whose errors do not know the file: its caller names it. */
inline void ofFile(const std::filesystem::path& path, auto compute)
{
  try
  {
    compute();
  }
  catch (const Error& error)
  {
    throw Error(path.string() + ": " + error.what() + '.');
  }
}

} // namespace smg::testing
