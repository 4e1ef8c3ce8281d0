// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/ReadAhead.h"

#include "smg/Error.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

// Threads for disk work: one that reads ranges ahead of their use, one that writes bytes behind the
// caller.
//
// These threads allocate nothing, since each allocating thread costs an arena of address space, and
// throw nothing: buffers are made by the caller, and a failure is a state that the caller finds.

namespace smg
{

namespace
{

constexpr std::size_t StackBytes = std::size_t(512) << 10;

/** Blocks all signals while a thread is created, which inherits the mask: signals are for the
 * threads of the program. */
class BlockedSignals
{
public:
  BlockedSignals()
  {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &this->Before);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &this->Before, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

private:
  sigset_t Before{};
};

} // namespace

IoThread::~IoThread()
{
  this->join();
}

void IoThread::start(std::function<void()> body)
{
  this->Body = std::move(body);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  // The default stack takes 8 MiB of address space for each thread.
  pthread_attr_setstacksize(&attributes, StackBytes);
  const BlockedSignals blocked;
  const int error = pthread_create(
    &this->Thread, &attributes,
    [](void* self) -> void*
    {
      static_cast<IoThread*>(self)->Body();
      return nullptr;
    },
    this);
  pthread_attr_destroy(&attributes);
  if (error != 0)
  {
    throw Error(
      "A thread for disk work cannot be started: " + std::generic_category().message(error) + ".");
  }
  this->Started = true;
}

void IoThread::join()
{
  if (std::exchange(this->Started, false))
  {
    pthread_join(this->Thread, nullptr);
  }
}

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

/** The caller holds the mutex, here and in oldestQueued(). */
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
  // The thread starts with the first request: readers that never ask for anything have none.
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
      // A range that is queued or being read must not be replaced: the thread is writing to its
      // memory, or will.
      if (!busy && (!chosen || range.age < chosen->age))
      {
        chosen = &range;
      }
    }
    if (!chosen)
    {
      return false;
    }
    // Allocated here, since the thread must not. If that fails, the range is free.
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
  // The caller reads it once more, and gets the error with its reason.
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
    // The range is in state Reading, so its memory stays while the lock is not held.
    lock.unlock();
    const int error = this->File.tryRead(offset, bytes);
    lock.lock();
    range->state = error == 0 ? State::Ready : State::Failed;
    this->Changed.notify_all();
  }
}

WriteBehind::WriteBehind(const FileDescriptor& file, std::int64_t offset, std::size_t bytes)
  : File(file)
  , Offset(offset)
{
  for (Chunk& chunk : this->Ring)
  {
    chunk.bytes.resize(std::max<std::size_t>(bytes / Chunks, 1));
  }
  // Three chunks: one that is filled, and two that wait or are being written.
  this->Ring[0].offset = offset;
}

WriteBehind::~WriteBehind()
{
  {
    const std::lock_guard lock(this->Mutex);
    this->Stop = true;
  }
  this->Changed.notify_all();
  this->Thread.join();
}

template <class Condition>
void WriteBehind::waitUntil(std::unique_lock<std::mutex>& lock, Condition condition)
{
  if (!condition())
  {
    const auto begin = std::chrono::steady_clock::now();
    this->Changed.wait(lock, condition);
    this->Waited += std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count();
  }
}

void WriteBehind::put(std::span<const std::byte> bytes)
{
  // Where the next bytes will be in the file, although these may not be written yet: an index can
  // be made at once.
  this->Offset += static_cast<std::int64_t>(bytes.size());
  while (!bytes.empty())
  {
    Chunk& chunk = this->Ring[this->Current];
    const std::size_t n = std::min(bytes.size(), chunk.bytes.size() - chunk.used);
    std::memcpy(chunk.bytes.data() + chunk.used, bytes.data(), n);
    chunk.used += n;
    bytes = bytes.subspan(n);
    if (chunk.used == chunk.bytes.size())
    {
      this->handOver();
    }
  }
}

void WriteBehind::handOver()
{
  if (!this->Thread.isStarted())
  {
    this->Thread.start([this] { this->run(); });
  }
  // Chunks follow each other in the file without gaps.
  const std::int64_t next =
    this->Ring[this->Current].offset + std::int64_t(this->Ring[this->Current].used);
  {
    std::unique_lock lock(this->Mutex);
    // Waking the thread for several chunks reduces wake-ups; one chunk remains to be filled.
    if (++this->Full >= Chunks - 1)
    {
      this->Changed.notify_all();
    }
    this->waitUntil(lock, [this] { return this->Full < Chunks; });
  }
  this->Current = (this->Current + 1) % Chunks;
  this->Ring[this->Current].used = 0;
  this->Ring[this->Current].offset = next;
}

void WriteBehind::flush()
{
  if (this->Ring[this->Current].used > 0)
  {
    this->handOver();
  }
  std::unique_lock lock(this->Mutex);
  this->Changed.notify_all();
  this->waitUntil(lock, [this] { return this->Full == 0; });
}

int WriteBehind::failed()
{
  const std::lock_guard lock(this->Mutex);
  return this->FirstError;
}

void WriteBehind::run()
{
  int next = 0;
  std::unique_lock lock(this->Mutex);
  for (;;)
  {
    this->Changed.wait(lock, [this] { return this->Full > 0 || this->Stop; });
    if (this->Stop)
    {
      return;
    }
    // After a failure nothing more is written; chunks are only counted, so that the caller does not
    // wait for ever.
    if (this->FirstError == 0)
    {
      const Chunk& chunk = this->Ring[next];
      lock.unlock();
      const int error = this->File.tryWrite(chunk.offset, std::span(chunk.bytes).first(chunk.used));
      lock.lock();
      this->FirstError = error;
    }
    next = (next + 1) % Chunks;
    this->Full--;
    this->Changed.notify_all();
  }
}

} // namespace smg
