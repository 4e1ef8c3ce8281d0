// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace smg
{

/**
 * Runs f() and g() on the arena, on two threads if it has two, and waits for both. What one of them
 * throws is thrown here.
 */
template <class F, class G>
void runBoth(tbb::task_arena& arena, F&& f, G&& g)
{
  // TBB orders the calls; the flags say so once more to a race detector, which cannot look into
  // TBB.
  std::atomic<bool> begun{ false };
  std::atomic<int> finished{ 0 };
  const auto run = [&begun, &finished](auto& work)
  {
    begun.load(std::memory_order_acquire);
    work();
    finished.fetch_add(1, std::memory_order_release);
  };
  begun.store(true, std::memory_order_release);
  arena.execute([&] { tbb::parallel_invoke([&] { run(f); }, [&] { run(g); }); });
  finished.load(std::memory_order_acquire);
}

} // namespace smg
