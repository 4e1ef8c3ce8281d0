// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Core/Workers.h"

#include "Solver/Core/Forks.h"
#include "smg/Error.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <new>
#include <pthread.h>
#include <sched.h>
#include <thread>
#include <utility>

// A team of threads that run jobs for their owner. The owner runs jobs itself while it waits for
// one, so everything makes progress even if no thread could be started, and one thread in all needs
// no special case. Jobs may take microseconds: threads spin for a moment before they sleep, unless
// there are more of them than cores.
//
// Threads do not cross a fork: in the child the owner runs all jobs itself, also those that were
// waiting. One that was running elsewhere when the process forked is lost.

namespace smg
{

namespace
{

/** About 20 microseconds. */
constexpr int MaxSpins = 400;
constexpr int MaxThreads = 64;
constexpr std::chrono::milliseconds BetweenPolls(100);

/** The default takes 8 MiB of address space for each thread. */
constexpr std::size_t StackBytes = std::size_t(1) << 20;

thread_local bool isOfWorkers = false;

void spinPause()
{
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

} // namespace

int Workers::cores()
{
  static const int count = []
  {
    cpu_set_t set;
    const bool isKnown = sched_getaffinity(0, sizeof(set), &set) == 0;
    return std::max(
      1, isKnown ? CPU_COUNT(&set) : static_cast<int>(std::thread::hardware_concurrency()));
  }();
  return count;
}

Workers::Workers(int threads)
  : Threads(std::clamp(threads > 0 ? threads : cores(), 1, MaxThreads))
{
  ForkedObjects::all().add(this, { [this] { this->Mutex.lock(); }, [this] { this->Mutex.unlock(); },
                                   [this]
                                   {
                                     // Threads of the parent may have waited for these, which could
                                     // not even be destroyed.
                                     new (&this->Mutex) std::mutex;
                                     new (&this->Submitted) std::condition_variable;
                                     new (&this->Finished) std::condition_variable;
                                     this->Sleeping = 0;
                                     this->Team.clear();
                                     this->IsComplete = true;
                                   } });
}

Workers::~Workers()
{
  ForkedObjects::all().remove(this);
  {
    const std::lock_guard lock(this->Mutex);
    this->Stop = true;
    this->HasWork = true;
  }
  this->Submitted.notify_all();
  for (const pthread_t thread : this->Team)
  {
    pthread_join(thread, nullptr);
  }
}

bool Workers::isCaller()
{
  return isOfWorkers;
}

/** Starts the threads, unless there are as many as wanted, or as the system permits. */
void Workers::start()
{
  const auto wanted = static_cast<std::size_t>(this->Threads - 1);
  if (this->IsComplete || this->Team.size() == wanted)
  {
    return;
  }
  this->Team.reserve(wanted); // a started thread must be kept
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, StackBytes);
  // Signals are for the threads of the program; a new thread inherits the mask.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  while (!this->IsComplete && this->Team.size() < wanted)
  {
    pthread_t thread{};
    const auto run = [](void* self) -> void*
    {
      static_cast<Workers*>(self)->runThread();
      return nullptr;
    };
    // Fewer threads than wanted are no failure: the owner runs what they do not.
    this->IsComplete = pthread_create(&thread, &attributes, run, this) != 0;
    if (!this->IsComplete)
    {
      this->Team.push_back(thread);
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
}

void Workers::submit(Job& job)
{
  this->start();
  bool isAwaited = false;
  {
    const std::lock_guard lock(this->Mutex);
    job.Failure = nullptr;
    job.IsDone.store(false, std::memory_order_relaxed);
    this->Waiting.push_back(&job);
    this->HasWork.store(true, std::memory_order_relaxed);
    // A thread that spins sees HasWork by itself; waking one costs a call to the system.
    isAwaited = this->Sleeping > 0;
  }
  if (isAwaited)
  {
    this->Submitted.notify_one();
  }
}

/** Spins for a moment, unless there are more threads than cores; returns whether the flag is set.
 */
bool Workers::spinUntil(const std::atomic<bool>& flag)
{
  const int spins = this->Threads <= cores() ? MaxSpins : 0;
  for (int i = 0; i < spins; ++i)
  {
    if (flag.load(std::memory_order_acquire))
    {
      return true;
    }
    spinPause();
  }
  return false;
}

void Workers::run(Job& job)
{
  try
  {
    job.Work();
  }
  catch (...)
  {
    // For Job::finish(): an exception must not leave the thread.
    job.Failure = std::current_exception();
  }
}

void Workers::runThread()
{
  // So code that may run in a job can tell that it must not submit jobs itself.
  isOfWorkers = true;
  std::unique_lock lock(this->Mutex);
  for (;;)
  {
    if (!this->Waiting.empty())
    {
      Job& job = *this->Waiting.front();
      this->Waiting.pop_front();
      // Threads that spin read this without the mutex; what counts is tested again under it.
      this->HasWork.store(this->Stop || !this->Waiting.empty(), std::memory_order_relaxed);
      lock.unlock();
      this->run(job);
      lock.lock();
      // Under the mutex, so that the owner cannot miss it between its test and its sleep.
      job.IsDone.store(true, std::memory_order_release);
      if (this->OwnerSleeps)
      {
        this->Finished.notify_one();
      }
      continue;
    }
    if (this->Stop)
    {
      return;
    }
    lock.unlock();
    const bool hasWork = this->spinUntil(this->HasWork);
    lock.lock();
    if (!hasWork)
    {
      ++this->Sleeping;
      this->Submitted.wait(lock, [this] { return this->Stop || !this->Waiting.empty(); });
      --this->Sleeping;
    }
  }
}

/** Runs waiting jobs until this one is done. The job itself may be among them. */
void Workers::wait(Job& job)
{
  std::unique_lock lock(this->Mutex);
  while (!job.IsDone.load(std::memory_order_relaxed))
  {
    if (!this->Waiting.empty())
    {
      Job& next = *this->Waiting.front();
      this->Waiting.pop_front();
      this->HasWork.store(!this->Waiting.empty(), std::memory_order_relaxed);
      lock.unlock();
      this->run(next);
      lock.lock();
      next.IsDone.store(true, std::memory_order_release);
      continue;
    }
    lock.unlock();
    const bool isDone = this->spinUntil(job.IsDone);
    lock.lock();
    if (!isDone)
    {
      // Nothing waits, so the job is running on another thread.
      if (this->Team.empty())
      {
        throw Error("The process was forked during a computation, which the child cannot continue: "
                    "start it again there.");
      }
      const auto isFinished = [&job] { return job.IsDone.load(std::memory_order_relaxed); };
      this->OwnerSleeps = true;
      while (this->Poll && !this->Finished.wait_for(lock, BetweenPolls, isFinished))
      {
        lock.unlock();
        this->Poll();
        lock.lock();
      }
      this->Finished.wait(lock, isFinished);
      this->OwnerSleeps = false;
    }
  }
}

void Workers::cancel(Job& job) noexcept
{
  {
    const std::lock_guard lock(this->Mutex);
    const auto waiting = std::ranges::find(this->Waiting, &job);
    // It has not begun and never will.
    if (waiting != this->Waiting.end())
    {
      this->Waiting.erase(waiting);
      this->HasWork.store(!this->Waiting.empty(), std::memory_order_relaxed);
      return;
    }
    // It is done; or it ran in the parent of a forked child.
    if (this->Team.empty())
    {
      return;
    }
  }
  this->wait(job);
}

} // namespace smg
