// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Multigrid/Schedule/Schedule.h"

#include <vector>

namespace smg::benchmark
{

/** How long the recorded passes of a solve take on some number of threads. */
class ScheduleModel
{
public:
  /** `blockNodes`: SolveOptions::blockNodes of the solves to model; the recorded one had steps of a
   * block of rows. */
  ScheduleModel(const std::vector<StepRecorder::Pass>& passes, std::int64_t blockNodes)
    : Passes(passes)
    , BlockNodes(blockNodes)
  {
  }

  /** Seconds of a pass. */
  double seconds(std::size_t pass, int threads) const;
  /** Seconds of a pass with any number of threads: those of its longest stage, and of what runs
   * between the steps. */
  double critical(std::size_t pass) const;
  /** Seconds of all passes. */
  double seconds(int threads) const;

private:
  static double concurrent(
    const std::vector<double>& tasks, const LongestTaskFirst& order, int threads);
  std::vector<StepRecorder::Step> scheduled(const StepRecorder::Pass& pass, int threads) const;

  const std::vector<StepRecorder::Pass>& Passes;
  std::int64_t BlockNodes;
};

} // namespace smg::benchmark
