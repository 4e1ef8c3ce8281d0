// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workers.h"

#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace smg
{

/**
 * An ordered pipeline of jobs with a bounded number of items: the owner fills an item, `work` is
 * done to it on any thread, and the owner takes the items in the order in which they were filled.
 * What it takes, and in which order, does therefore not depend on the number of threads; nor does
 * an exception, which is thrown when its item is to be taken.
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
  ~OrderedJobs()
  {
    for (; this->Count > 0; --this->Count)
    {
      this->Threads.cancel(this->oldest().job);
      ++this->Oldest;
    }
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
    this->Threads.submit(this->slot(this->Oldest + this->Count).job);
    ++this->Count;
  }

  /** Waits for the oldest item and takes it. There must be one. */
  void takeOldest()
  {
    assert(this->Count > 0);
    Slot& slot = this->oldest();
    ++this->Oldest;
    --this->Count;
    this->Threads.finish(slot.job);
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
      : job([&owner, this] { owner.Work(this->item); })
    {
    }
    Item item;
    Workers::Job job;
  };

  Slot& slot(std::size_t number) { return *this->Slots[number % this->Most]; }
  Slot& oldest() { return this->slot(this->Oldest); }

  Workers& Threads;
  const std::size_t Most;
  Function Work, Take;
  std::vector<std::unique_ptr<Slot>> Slots; ///< a ring
  std::size_t Oldest = 0, Count = 0;
};

} // namespace smg
