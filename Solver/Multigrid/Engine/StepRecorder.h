// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"

#include <utility>
#include <vector>

namespace smg
{

/**
 * Performs the tasks of the steps of a solve one after the other and keeps their processor times,
 * from which a model tells how long they take on any number of threads
 * (Testing/Benchmarks/ScheduleModel.h).
 */
class StepRecorder
{
public:
  struct Step
  {
    double before = 0.0;       ///< seconds since the step before this one, or the start of the pass
    std::vector<double> tasks; ///< seconds of each task
  };
  struct Pass
  {
    std::vector<double> costs; ///< of the stages, which come first among the tasks; see Pipeline
    std::vector<Step> steps;
  };

  /** Starts a pass with stages of these costs; none in the first pass. */
  void startPass(std::vector<double> costs)
  {
    this->Passes.push_back({ std::move(costs), {} });
    this->Since = processSeconds();
  }

  /** Performs a step: task(0) .. task(count - 1). */
  template <class Task>
  void run(int count, Task&& task)
  {
    Step step{ this->lap(), {} };
    for (int k = 0; k < count; ++k)
    {
      task(k);
      step.tasks.push_back(this->lap());
    }
    this->Passes.back().steps.push_back(std::move(step));
  }

  const std::vector<Pass>& passes() const { return this->Passes; }

private:
  double lap()
  {
    const double now = processSeconds();
    return now - std::exchange(this->Since, now);
  }

  std::vector<Pass> Passes;
  double Since = 0.0;
};

} // namespace smg
