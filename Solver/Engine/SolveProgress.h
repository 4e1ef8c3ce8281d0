// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"

#include <cmath>

namespace smg
{

/**
 * The progress of a solve, whose number of passes is not known before: the first pass counts for
 * a fixed share, the rest by how far the residual has come on the way to the tolerance.
 */
class SolveProgress
{
public:
  SolveProgress(ProgressFunction function, double tolerance, int maxCycles)
    : Overall(std::move(function))
    , LogTolerance(std::log(tolerance))
    , MaxCycles(maxCycles)
  {
  }

  /** Share `done` (0 to 1) of the pass of V-cycle `cycle`; 0: the first pass. */
  void update(int cycle, double done)
  {
    this->Overall.update(
      cycle == 0 ? FirstPass * done
                 : FirstPass +
                     (1.0 - FirstPass) * (this->Reached + (this->Expected - this->Reached) * done));
  }

  /** V-cycle `cycle` has ended with this relative residual. */
  void endCycle(int cycle, double residual)
  {
    const double before = this->Reached;
    const double byResidual = residual > 0.0 ? std::log(residual) / this->LogTolerance : 1.0;
    const double byCycles = static_cast<double>(cycle) / this->MaxCycles;
    this->Reached = std::clamp(std::max(byResidual, byCycles), before, 1.0);
    const double gain = std::max(this->Reached / (cycle + 1), 1.0 / this->MaxCycles);
    this->Expected = std::min(1.0, this->Reached + gain);
  }

  void finish() { this->Overall.update(1.0); }

private:
  static constexpr double FirstPass = 0.4;

  Progress Overall;
  double LogTolerance;
  int MaxCycles;
  double Reached = 0.0;
  double Expected = 0.1;
};

} // namespace smg
