// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Multigrid/Engine/Convergence.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace smg
{

/** The progress of a solve, whose number of passes is not known in advance: the first pass
 * counts for a fixed share, the rest by the decrease of the residual towards the tolerance, on
 * a logarithmic scale, or by the V-cycles if their number is fixed. */
class SolveProgress
{
public:
  explicit SolveProgress(ProgressFunction function)
    : Function(std::move(function))
  {
  }

  /** Begins a problem that counts from `from` to `to`; at 0 the progress restarts. `builds`:
   * whether the problem includes the first pass. */
  void begin(const Stopping& stopping, double from, double to, bool builds)
  {
    const double first = builds ? FirstPass : 0.0;
    if (from == 0.0)
    {
      this->Overall = Progress(this->Function);
    }
    this->From = from;
    this->Start = from + first * (to - from);
    this->To = to;
    this->LogTolerance = stopping.cycles > 0 ? 0.0 : std::log(stopping.tolerance);
    this->MaxCycles = stopping.cycles > 0 ? stopping.cycles : stopping.maxCycles;
    this->Reached = 0.0;
    this->Expected = 0.1;
  }

  /** Begins a first pass that nothing follows. */
  void beginFirst()
  {
    this->Overall = Progress(this->Function);
    this->From = 0.0;
    this->Start = 1.0;
  }

  /** The share `done` (0 to 1) of the first pass is done. */
  void updateFirst(double done)
  {
    this->Overall.update(this->From + (this->Start - this->From) * done);
  }
  /** The share `done` (0 to 1) of the pass of a V-cycle is done. */
  void update(double done)
  {
    const double reached = this->Reached + (this->Expected - this->Reached) * done;
    this->Overall.update(this->Start + (this->To - this->Start) * reached);
  }

  /** Leaves room for what is likely to follow the V-cycles. */
  void leaveRoom() { this->To = this->Start + WithoutRest * (this->To - this->Start); }
  /** How far it has come: 1 unless there is room for more. */
  double done() const { return this->Overall.done(); }

  /** The relative residual to reach, if that is not the tolerance. */
  void expect(double goal)
  {
    this->LogTolerance =
      this->LogTolerance == 0.0 || goal >= 1.0 ? this->LogTolerance : std::log(goal);
  }

  /** V-cycle number `cycle` has ended with this relative residual. */
  void endCycle(int cycle, double residual)
  {
    const double before = this->Reached;
    const double byResidual = this->LogTolerance == 0.0 ? 0.0
                              : residual > 0.0          ? std::log(residual) / this->LogTolerance
                                                        : 1.0;
    const double byCycles = static_cast<double>(cycle) / this->MaxCycles;
    this->Reached = std::clamp(std::max(byResidual, byCycles), before, 1.0);
    const double gain = std::max(this->Reached / (cycle + 1), 1.0 / this->MaxCycles);
    this->Expected = std::min(1.0, this->Reached + gain);
  }

  /** V-cycles with these relative residuals have ended, in a program from whose checkpoint this
   * one continues. */
  void repeat(const std::vector<double>& residuals)
  {
    for (std::size_t k = 0; k < residuals.size(); ++k)
    {
      this->endCycle(static_cast<int>(k) + 1, residuals[k]);
    }
  }

  void finish() { this->Overall.update(this->To); }

private:
  static constexpr double FirstPass = 0.4;
  static constexpr double WithoutRest = 0.4; // of what is to come after the first pass

  ProgressFunction Function;
  Progress Overall;
  double From = 0.0, Start = 0.0, To = 1.0;
  double LogTolerance = 0.0;
  int MaxCycles = 1;
  double Reached = 0.0;
  double Expected = 0.1;
};

} // namespace smg
