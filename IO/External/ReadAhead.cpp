// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ReadAhead.h"

#include <chrono>

namespace smg
{

ReadAhead::ReadAhead(const FileDescriptor& file)
  : File(file)
{
}

ReadAhead::~ReadAhead()
{
  {
    const std::lock_guard lock(this->Mutex);
    this->Stop = true;
  }
  this->Changed.notify_all();
  this->Thread.join();
}

ReadAhead::Range* ReadAhead::lookUp(std::int64_t offset, std::size_t bytes)
{
  for (Range& range : this->Kept)
  {
    if (range.state != State::Free && range.offset <= offset &&
        offset + static_cast<std::int64_t>(bytes) <= range.end())
    {
      return &range;
    }
  }
  return nullptr;
}

ReadAhead::Range* ReadAhead::oldestQueued()
{
  Range* oldest = nullptr;
  for (Range& range : this->Kept)
  {
    if (range.state == State::Queued && (!oldest || range.age < oldest->age))
    {
      oldest = &range;
    }
  }
  return oldest;
}

bool ReadAhead::request(std::int64_t offset, std::size_t bytes)
{
  if (!this->Thread.isStarted())
  {
    this->Thread.start([this] { this->run(); });
  }
  {
    const std::lock_guard lock(this->Mutex);
    if (this->lookUp(offset, bytes))
    {
      return false;
    }
    Range* chosen = nullptr;
    for (Range& range : this->Kept)
    {
      const bool busy = range.state == State::Queued || range.state == State::Reading;
      if (!busy && (!chosen || range.age < chosen->age))
      {
        chosen = &range;
      }
    }
    if (!chosen)
    {
      return false;
    }
    // Allocated here, since the thread must not allocate.
    if (chosen->bytes.size() < bytes)
    {
      chosen->state = State::Free;
      chosen->bytes.resize(bytes);
    }
    chosen->offset = offset;
    chosen->size = bytes;
    chosen->age = ++this->Requests;
    chosen->state = State::Queued;
  }
  this->Changed.notify_all();
  return true;
}

std::optional<std::span<const std::byte>> ReadAhead::find(std::int64_t offset, std::size_t bytes)
{
  std::unique_lock lock(this->Mutex);
  const Range* range = this->lookUp(offset, bytes);
  if (!range)
  {
    return {};
  }
  const auto isRead = [range] { return range->state >= State::Ready; };
  if (!isRead())
  {
    const auto begin = std::chrono::steady_clock::now();
    this->Changed.wait(lock, isRead);
    this->Waited += std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count();
  }
  if (range->state == State::Failed)
  {
    return {};
  }
  return std::span(range->bytes).subspan(static_cast<std::size_t>(offset - range->offset), bytes);
}

void ReadAhead::release(std::int64_t end)
{
  const std::lock_guard lock(this->Mutex);
  for (Range& range : this->Kept)
  {
    if (range.end() == end && (range.state == State::Ready || range.state == State::Failed))
    {
      range.state = State::Free;
      range.age = 0;
    }
  }
}

void ReadAhead::run()
{
  std::unique_lock lock(this->Mutex);
  for (;;)
  {
    this->Changed.wait(lock, [this] { return this->Stop || this->oldestQueued(); });
    if (this->Stop)
    {
      return;
    }
    Range* range = this->oldestQueued();
    range->state = State::Reading;
    const std::int64_t offset = range->offset;
    const std::span bytes = std::span(range->bytes).first(range->size);
    lock.unlock();
    const int error = this->File.tryRead(offset, bytes);
    lock.lock();
    range->state = error == 0 ? State::Ready : State::Failed;
    this->Changed.notify_all();
  }
}

} // namespace smg
