// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace smg
{

/**
 * The order in which threads begin the tasks of each of many steps: those that took the longest in
 * the steps so far come first, so that the threads become idle at about the same time (Graham,
 * 1969). Only task 0 is always the first one.
 */
class LongestFirst
{
public:
  explicit LongestFirst(int tasks)
    : Order(static_cast<std::size_t>(tasks))
    , Seconds(static_cast<std::size_t>(tasks))
  {
    std::iota(this->Order.begin(), this->Order.end(), 0);
  }

  int tasks() const { return static_cast<int>(this->Order.size()); }
  int operator[](int place) const { return this->Order[static_cast<std::size_t>(place)]; }

  /** Adds the time of a task in a step: for different tasks, on any threads. */
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

} // namespace smg
