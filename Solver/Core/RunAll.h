// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace smg
{

/**
 * Runs task(0) .. task(count - 1) on the threads of the arena, each thread taking the next one that
 * is left, and waits for all. What one of them throws is thrown here.
 */
template <class Task>
void runAll(tbb::task_arena& arena, int count, Task&& task)
{
  // TBB orders the calls; the flags say so once more to a race detector, which cannot look into
  // TBB.
  std::atomic<bool> begun{ false };
  std::atomic<int> next{ 0 }, finished{ 0 };
  const auto work = [&](int)
  {
    begun.load(std::memory_order_acquire);
    for (int k = next.fetch_add(1); k < count; k = next.fetch_add(1))
    {
      task(k);
    }
    finished.fetch_add(1, std::memory_order_release);
  };
  begun.store(true, std::memory_order_release);
  const int threads = std::min(count, arena.max_concurrency());
  arena.execute(
    [&]
    {
      if (threads == 1)
      {
        work(0);
      }
      else
      {
        tbb::parallel_for(0, threads, work, tbb::simple_partitioner());
      }
    });
  finished.load(std::memory_order_acquire);
}

} // namespace smg
