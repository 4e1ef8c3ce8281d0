// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <pthread.h>

namespace smg
{

/** A thread for disk I/O or for Workers. Its stack is small and its function should allocate no
 * memory: there may be tens of these threads, and each allocating thread costs an arena of address
 * space. */
class IoThread
{
public:
  IoThread() = default;
  ~IoThread();
  IoThread(const IoThread&) = delete;
  IoThread& operator=(const IoThread&) = delete;

  bool isStarted() const { return this->Started; }
  /** Runs `body`, which must not throw, on the thread. Throws Error if the thread cannot be
   * created. */
  void start(std::function<void()> body);
  /** Waits for the end of the body. */
  void join();

private:
  std::function<void()> Body;
  pthread_t Thread{};
  bool Started = false;
};

} // namespace smg
