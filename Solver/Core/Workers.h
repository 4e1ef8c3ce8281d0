// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <pthread.h>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Threads that run jobs for another one, their owner. The owner runs jobs as well while it waits
 * for one, so jobs make progress with any number of threads, even none. Jobs are begun in the order
 * in which they were submitted. A thread without jobs spins for a moment before it sleeps, since
 * jobs may take microseconds.
 *
 * The mutex orders what the owner does before submit() and after finish() and what the job does, in
 * a way that race detectors see.
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

  /** The number of cores that this process may use. */
  static int cores();
  /** The number of jobs that can run at once, with one of the owner. */
  int threads() const { return this->Threads; }

  /** What the owner does about ten times a second while it sleeps until a job is done. It must not
   * throw: it may tell the jobs to end. */
  void whileSleeping(std::function<void()> poll) { this->Poll = std::move(poll); }

  /** Whether the caller is a thread of some workers, and not an owner. */
  static bool isCaller();

  /** Work that the owner may submit any number of times, but only once at a time. The destructor
   * waits until it is done, or removes it if it has not begun. */
  class Job
  {
  public:
    /** The workers must outlive it. */
    Job(Workers& workers, std::function<void()> work)
      : Team(workers)
      , Work(std::move(work))
    {
    }
    ~Job()
    {
      if (this->IsPending)
      {
        this->Team.cancel(*this);
      }
    }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    void submit()
    {
      this->Team.submit(*this);
      this->IsPending = true;
    }
    /** Whether it was submitted and not finished. */
    bool isPending() const { return this->IsPending; }
    /** If it is pending, waits until it is done, and rethrows its exception. */
    void finish()
    {
      if (std::exchange(this->IsPending, false))
      {
        this->Team.wait(*this);
        if (this->Failure)
        {
          std::rethrow_exception(std::exchange(this->Failure, nullptr));
        }
      }
    }

  private:
    friend class Workers;
    Workers& Team;
    std::function<void()> Work;
    bool IsPending = false; ///< not accessed by the threads
    std::exception_ptr Failure;
    std::atomic<bool> IsDone{ false };
  };

private:
  void start();
  void submit(Job& job);
  void cancel(Job& job) noexcept;
  void runThread();
  void run(Job& job);
  void wait(Job& job);
  bool spinUntil(const std::atomic<bool>& flag);

  const int Threads;
  std::function<void()> Poll;
  std::mutex Mutex;
  std::condition_variable Submitted; ///< for the threads
  std::condition_variable Finished;  ///< for the owner, the only one who submits
  std::deque<Job*> Waiting;
  std::atomic<bool> HasWork{ false }; ///< jobs wait, or the threads shall end
  bool Stop = false;
  int Sleeping = 0; ///< threads
  bool OwnerSleeps = false;
  bool IsComplete = false; ///< no more threads can be started
  std::vector<pthread_t> Team;
};

/** Runs task(0) .. task(count - 1), each once, and waits for all: task(0) on the calling thread,
 * the others, in this order, on any thread that is free. Rethrows the exception of the task with
 * the lowest number. */
template <class Task>
void runAll(Workers& workers, int count, Task&& task)
{
  std::mutex mutex;
  int failed = count;
  std::exception_ptr failure;
  const auto run = [&](int k)
  {
    try
    {
      task(k);
    }
    catch (...)
    {
      const std::lock_guard lock(mutex);
      failure = k < failed ? std::current_exception() : failure;
      failed = std::min(failed, k);
    }
  };
  std::atomic<int> next{ 1 };
  const auto others = [&]
  {
    for (int k = next++; k < count; k = next++)
    {
      run(k);
    }
  };
  {
    std::deque<Workers::Job> helpers;
    for (int k = 1; k < std::min(count, workers.threads()); ++k)
    {
      helpers.emplace_back(workers, others).submit();
    }
    if (count > 0)
    {
      run(0);
    }
    others();
    // Here every task has begun; the helpers that have not are removed.
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

/**
 * An ordered pipeline of jobs with a bounded number of items: the owner fills an item, `work` is
 * done to it on any thread, and the owner takes the items in the order in which they were filled.
 * So what it takes, and in which order, does not depend on the number of threads; nor does an
 * exception, which is thrown when its item is to be taken.
 */
template <class Item>
class OrderedJobs
{
public:
  using Function = std::function<void(Item&)>;

  /** The workers must outlive it. At most `most` items, at least 1, are in use at once.
   * @param work on any thread, on several items at once
   * @param take by the owner */
  OrderedJobs(Workers& workers, std::size_t most, Function work, Function take)
    : Threads(workers)
    , Most(most)
    , Work(std::move(work))
    , Take(std::move(take))
    , Slots(most)
  {
  }
  OrderedJobs(const OrderedJobs&) = delete;
  OrderedJobs& operator=(const OrderedJobs&) = delete;

  Workers& workers() const { return this->Threads; }
  /** The number of items that may be in use at once. */
  std::size_t most() const { return this->Most; }
  /** The number of submitted items that were not taken. */
  std::size_t size() const { return this->Count; }

  /** An item to fill, with what it had before: first takes the oldest one if all are in use. */
  Item& next()
  {
    if (this->Count == this->Most)
    {
      this->takeOldest();
    }
    std::unique_ptr<Slot>& slot = this->Slots[(this->Oldest + this->Count) % this->Most];
    if (!slot)
    {
      slot = std::make_unique<Slot>(*this);
    }
    return slot->item;
  }
  /** Hands over the item of the last next(). */
  void submit()
  {
    this->slot(this->Oldest + this->Count).job.submit();
    ++this->Count;
  }

  /** Waits for the oldest item and takes it. There must be one. */
  void takeOldest()
  {
    assert(this->Count > 0);
    Slot& slot = this->slot(this->Oldest);
    ++this->Oldest;
    --this->Count;
    slot.job.finish();
    this->Take(slot.item);
  }
  void takeAll()
  {
    while (this->Count > 0)
    {
      this->takeOldest();
    }
  }

private:
  struct Slot
  {
    explicit Slot(OrderedJobs& owner)
      : job(owner.Threads, [&owner, this] { owner.Work(this->item); })
    {
    }
    Item item;
    Workers::Job job;
  };

  Slot& slot(std::size_t number) { return *this->Slots[number % this->Most]; }

  Workers& Threads;
  const std::size_t Most;
  Function Work, Take;
  std::vector<std::unique_ptr<Slot>> Slots; ///< a ring
  std::size_t Oldest = 0, Count = 0;
};

} // namespace smg
