// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace smg
{

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

/** Runs task(0) .. task(count - 1) on the threads of the arena and waits for all: task(0) on the
 * calling thread, the others on any thread that is free. An exception of a task is rethrown. */
template <class Task>
void runAll(tbb::task_arena& arena, int count, Task&& task)
{
  // TBB orders the calls; the flags repeat this order for race detectors, which do not see into
  // TBB.
  std::atomic<bool> begun{ false };
  std::atomic<int> next{ 1 }, finished{ 0 };
  const auto others = [&]
  {
    begun.load(std::memory_order_acquire);
    for (int k = next.fetch_add(1); k < count; k = next.fetch_add(1))
    {
      task(k);
    }
    finished.fetch_add(1, std::memory_order_release);
  };
  begun.store(true, std::memory_order_release);
  arena.execute(
    [&]
    {
      tbb::task_group helpers;
      for (int k = 1; k < std::min(count, arena.max_concurrency()); ++k)
      {
        helpers.run(others);
      }
      try
      {
        task(0);
        others();
      }
      catch (...)
      {
        helpers.wait();
        throw;
      }
      helpers.wait();
    });
  finished.load(std::memory_order_acquire);
}

} // namespace smg
