// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/IoThread.h"
#include "smg/Export.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace smg
{

/**
 * Threads that run jobs for another one, their owner. The owner runs jobs, too, while it waits for
 * one: so jobs make progress with any number of threads, also without any. Jobs are begun in the
 * order in which they were submitted. A thread without jobs spins for a moment before it sleeps,
 * since jobs may take microseconds.
 *
 * Its mutex orders the accesses of the owner before submit() and after finish(), and those of the
 * job, as race detectors can see.
 */
class SMG_EXPORT Workers
{
public:
  /** `threads`: in total, with the owner's; 0: one per core. Threads start with the first job. */
  explicit Workers(int threads = 0);
  /** All jobs must be finished. */
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /** The number of jobs that can run at once, with one of the owner. */
  int threads() const { return this->Threads; }

  /** Whether the caller is a thread of any workers, not an owner. */
  static bool isCaller();

  /** Work that is submitted any number of times, one after the other. */
  class Job
  {
  public:
    explicit Job(std::function<void()> work)
      : Work(std::move(work))
    {
    }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

  private:
    friend class Workers;
    std::function<void()> Work;
    std::exception_ptr Failure;
    std::atomic<bool> IsDone{ false };
  };

  void submit(Job& job);
  /** Waits until a submitted job is done, and rethrows its exception. */
  void finish(Job& job);
  /** Waits until a submitted job is done, or removes it if it has not begun. */
  void cancel(Job& job) noexcept;

private:
  void start();
  void runThread();
  void run(Job& job);
  void wait(Job& job);
  bool spinUntil(const std::atomic<bool>& flag);

  const int Threads;
  std::mutex Mutex;
  std::condition_variable Submitted; ///< for the threads
  std::condition_variable Finished;  ///< for the owner, the only one who submits
  std::deque<Job*> Waiting;
  std::atomic<bool> HasWork{ false }; ///< jobs wait, or the threads shall end
  bool Stop = false;
  int Sleeping = 0; ///< threads
  bool OwnerSleeps = false;
  bool IsComplete = false; ///< no more threads can be started
  std::vector<std::unique_ptr<IoThread>> Team;
};

/** Runs task(0) .. task(count - 1), each once, on all threads and waits for them. An exception of
 * the task of the lowest number is rethrown. */
template <class Task>
void runAll(Workers& workers, int count, Task&& task)
{
  std::vector<std::unique_ptr<Workers::Job>> jobs;
  for (int k = 0; k < count; ++k)
  {
    jobs.push_back(std::make_unique<Workers::Job>([&task, k] { task(k); }));
  }
  std::exception_ptr failure;
  std::size_t submitted = 0;
  try
  {
    for (; submitted < jobs.size(); ++submitted)
    {
      workers.submit(*jobs[submitted]);
    }
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  for (std::size_t k = 0; k < submitted; ++k)
  {
    try
    {
      workers.finish(*jobs[k]);
    }
    catch (...)
    {
      failure = failure ? failure : std::current_exception();
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace smg
