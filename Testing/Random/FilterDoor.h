// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>

// What passes between the random cases and VTK, whose headers and those of nlohmann-json exclude
// each other.
namespace smg::testing
{

/** A solve by the VTK filter. */
struct FilterRun
{
  std::filesystem::path mesh, scratch; ///< a .vsm file, a folder
  std::string problem;                 ///< JSON
  std::int64_t vertices;               ///< below which original numbers are looked at
  int columns, pieces, threads, sweeps, acceleration;
  bool inCore;
};

struct FilterResult
{
  Eigen::MatrixXd values; ///< vertices x columns
  std::string report;     ///< JSON
};

/** Solves, with a tolerance near rounding; throws Error. */
FilterResult solveByFilter(const FilterRun& run);

} // namespace smg::testing
