// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace smg
{

/**
 * The next node that a stage will process: it has finished all nodes below. There are two values.
 * The stage itself, and stages that follow it on the same thread, use the present one. Stages on
 * other threads see the one that was published between two steps. What they may process in a step,
 * and with it the memory of the pass, is therefore independent of how far the thread of this stage
 * happens to have come.
 */
class Cursor
{
public:
  Cursor() = default;
  /** Present and published. */
  explicit Cursor(std::int64_t node)
    : Node(node)
    , Published(node)
  {
  }
  Cursor& operator=(std::int64_t node)
  {
    this->Node = node;
    return *this;
  }
  /** The present node, for the stage itself. */
  operator std::int64_t() const { return this->Node; }
  /** The node that a stage may rely on which `follows` this one on the same thread, or does not. */
  std::int64_t seen(bool follows) const { return follows ? this->Node : this->Published; }
  /** The published node, for stages on other threads. */
  std::int64_t published() const { return this->Published; }
  /** Publishes the present node. */
  void publish() { this->Published = this->Node; }

private:
  std::int64_t Node = 0;
  std::int64_t Published = 0;
};

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
  /** Appends a stage, which nodes pass after those before it. Until cut() all are one chain. */
  void add(Stage stage);
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
  /** Advances all stages, each following the one before it. */
  void advance();
  /** The seconds that a stage has taken so far. */
  double seconds(std::size_t stage) const { return this->Seconds[stage]; }

  /**
   * Performs the steps of a pass: as long as prepare() returns true, it runs all tasks, and then
   * settle(). prepare() makes data available and publishes the cursors; settle() releases data.
   * `context` runs the tasks, see SolveContext::runConcurrently().
   */
  template <class Context, class Prepare, class Settle>
  void perform(Context& context, Prepare&& prepare, Settle&& settle)
  {
    LongestTaskFirst order(this->tasks());
    while (prepare())
    {
      context.runConcurrently(order, [this](int task) { this->run(task); });
      settle();
    }
  }

private:
  void advance(std::size_t stage, bool follows);

  std::vector<Stage> Stages;
  std::vector<double> Seconds;   // by stage
  std::vector<std::size_t> Ends; // of each chain, the end of its stages in Stages
  std::vector<std::function<void()>> Beside;
};

} // namespace smg
