// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/WriteBehind.h"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace smg
{

WriteBehind::WriteBehind(const FileDescriptor& file, std::int64_t offset, std::size_t bytes)
  : File(file)
  , Offset(offset)
{
  for (Chunk& chunk : this->Ring)
  {
    chunk.bytes.resize(std::max<std::size_t>(bytes / Chunks, 1));
  }
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
