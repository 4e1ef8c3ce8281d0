// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Timer.h"
#include "Solver/Core/Workers.h"
#include "Solver/Multigrid/Schedule/StepTrace.h"
#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/** One operation on the nodes of one level, in stream order. */
struct Stage
{
  const char* name;
  int level;
  /** About the time of the whole pass, in any unit. */
  double cost;
  /** Advances its cursor as far as those of other stages permit. It `follows` the stage before it
   * on the same thread, or that one may be advancing on another thread at the same time. */
  std::function<void(bool follows)> advance;
};

/** The order in which threads begin the tasks of a step that is repeated many times: those that
 * have taken the longest so far come first, so that the threads become idle at about the same time
 * (Graham, 1969). Task 0 is always the first one. */
class LongestTaskFirst
{
public:
  explicit LongestTaskFirst(int tasks)
    : Order(static_cast<std::size_t>(tasks))
    , Seconds(static_cast<std::size_t>(tasks))
  {
    std::iota(this->Order.begin(), this->Order.end(), 0);
  }

  int tasks() const { return static_cast<int>(this->Order.size()); }
  int operator[](int place) const { return this->Order[static_cast<std::size_t>(place)]; }

  /** Adds the time of a task in a step. Threads may do so at the same time for different tasks. */
  void add(int task, double seconds) { this->Seconds[static_cast<std::size_t>(task)] += seconds; }
  /** To be called between steps. */
  void sort()
  {
    std::ranges::stable_sort(this->Order.begin() + 1, this->Order.end(), std::greater(),
      [this](int task) { return this->Seconds[static_cast<std::size_t>(task)]; });
  }

private:
  std::vector<int> Order;
  std::vector<double> Seconds;
};

/** Keeps the processor times of the tasks of each step of a solve. From these a model computes how
 * long the steps take on any number of threads (Testing/Benchmarks/ScheduleModel.h). */
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
    std::vector<double> costs; ///< of the stages, which come first among the tasks; see Schedule
    std::vector<Step> steps;
  };

  /** Starts a pass with stages of these costs; there are none in the first pass. */
  void startPass(std::vector<double> costs)
  {
    this->Passes.push_back({ std::move(costs), {} });
    this->Since = processSeconds();
  }
  void startStep() { this->Passes.back().steps.push_back({ this->lap(), {} }); }
  /** The next task of the step has been performed. */
  void endTask() { this->Passes.back().steps.back().tasks.push_back(this->lap()); }

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

/** The threads that perform the steps of a solve. */
struct SMG_EXPORT StepThreads
{
  /** The requested number; 0: one per core. */
  explicit StepThreads(int wanted);

  /** Whether the tasks of a step may run at the same time: then it is worth while to have more of
   * them. */
  bool areConcurrent() const { return this->scheduled > 1 || this->recorder; }

  /** The number that a pass is scheduled for. The machine may have fewer: then it only changes how
   * passes are cut into tasks. */
  int scheduled;
  Workers workers;
  /** If there is one, it records the tasks, which are performed one after the other. */
  StepRecorder* recorder = nullptr;
};

/**
 * The stages of a pass and the steps in which they advance: the one place where order and threads
 * are decided. A step is bulk-synchronous. Between two steps cursors are published; in a step the
 * tasks run at the same time, those that took the longest first. A task is a chain of consecutive
 * stages, each of which follows the one before it, or what reads and writes files beside them.
 *
 * Chains begin a step with the cursors that the others had published at its beginning. Neither the
 * results nor the memory depend on which thread is faster. The more chains, the more nodes lie
 * between the first stage and the last one, and the larger the windows.
 */
class SMG_EXPORT Schedule
{
public:
  Schedule() = default;
  /** `trace` reports each step. */
  explicit Schedule(StepTrace trace)
    : Trace(std::move(trace))
  {
  }

  /** Appends a stage, which nodes pass after those before it, to the last chain. */
  void add(Stage stage);
  /** The same, of a stage whose next node is `cursor`, for traces; `sweep`: its number there, 0 if
   * it is none. */
  void add(Stage stage, StepTrace::Node cursor, std::size_t sweep = 0);
  StepTrace& trace() { return this->Trace; }
  /** The next stage begins another chain. */
  void startChain();
  /** Adds a task that may run beside all stages. */
  void addBeside(std::function<void()> task) { this->Beside.push_back(std::move(task)); }

  /** Cuts the stages into at most this many chains of about the same cost, at least 1. */
  void cut(int chains);
  /** Makes a chain of each stage. */
  void cutAll();

  /** The number of chains for a number of threads: twice as many, since chains are not equally
   * long and a thread should find another one when it is done. */
  static int chainsFor(int threads) { return threads == 1 ? 1 : 2 * threads; }
  /** The nodes of a step, given the usual number for a few threads. Many threads need longer
   * steps, in which the time of each stage is closer to its mean. */
  static std::int64_t stepFor(int threads, std::int64_t nodes)
  {
    constexpr int Many = 6;
    const bool isAll = nodes > std::numeric_limits<std::int64_t>::max() / 2;
    return threads < Many || isAll ? nodes : 2 * nodes;
  }

  const std::vector<Stage>& stages() const { return this->Stages; }
  std::vector<double> costs() const;
  int chains() const { return static_cast<int>(this->Ends.size()); }
  /** Chains, and then what runs beside them. */
  int tasks() const { return this->chains() + static_cast<int>(this->Beside.size()); }
  /** The number of stages in the chains before this one. */
  std::size_t begin(int chain) const
  {
    return chain == 0 ? 0 : this->Ends[static_cast<std::size_t>(chain) - 1];
  }

  /** Performs a task of a step. Different tasks may run at the same time. */
  void run(int task);
  /** Advances all stages, or those from this one on, each following the one before it. */
  void advance(std::size_t first = 0);
  /** The seconds that a stage has taken so far. */
  double seconds(std::size_t stage) const { return this->Seconds[stage]; }

  /**
   * Performs the steps of a pass: as long as prepare() returns true, it runs all tasks, and then
   * settle(). prepare() makes data available and publishes the cursors; settle() releases data.
   */
  void perform(StepThreads& threads, const std::function<bool()>& prepare,
    const std::function<void()>& settle);

private:
  StepTrace Trace;
  std::vector<Stage> Stages;
  std::vector<double> Seconds;   // by stage
  std::vector<std::size_t> Ends; // of each chain, the end of its stages in Stages
  std::vector<std::function<void()>> Beside;
};

} // namespace smg
