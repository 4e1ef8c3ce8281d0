// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>
#include <vector>

namespace smg::testing
{

/** Calls run(0), run(1), ... run(count - 1) concurrently, each on its own thread. */
void runAtOnce(int count, const auto& run)
{
  std::vector<std::thread> threads;
  for (int k = 0; k < count; ++k)
  {
    threads.emplace_back([&run, k] { run(k); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

} // namespace smg::testing
