// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Workers.h"
#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/IoStatistics.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{

/** Writes bytes to a file one after another, on a thread of its own. The bytes are copied into a
 * few chunks of memory; the caller waits only if all chunks are pending. */
class WriteBehind
{
public:
  /** Writes from `offset` on, with chunks of `bytes` bytes in total. The file must outlive it. */
  WriteBehind(const FileDescriptor& file, std::int64_t offset, std::size_t bytes)
    : File(file)
    , Offset(offset)
    , ChunkBytes(std::max<std::size_t>(bytes / Chunks, 1))
    , Pending(
        this->Threads, Chunks, [this](Chunk& chunk) { this->write(chunk); }, [](Chunk&) {})
  {
  }

  /** The file offset of the next byte. */
  std::int64_t offset() const { return this->Offset; }
  /** Total nanoseconds in which put() and flush() waited. */
  std::int64_t waitNanoseconds() const { return this->Waited; }

  /** Appends bytes. A failed write is not thrown but reported by failed(). */
  void put(std::span<const std::byte> bytes)
  {
    while (!bytes.empty())
    {
      if (!this->Current)
      {
        const WaitClock clock;
        this->Current = &this->Pending.next();
        this->Waited += clock.nanoseconds();
        this->Current->bytes.clear();
        this->Current->bytes.reserve(this->ChunkBytes);
        this->Current->offset = this->Offset;
      }
      std::vector<std::byte>& chunk = this->Current->bytes;
      const auto part = bytes.first(std::min(bytes.size(), this->ChunkBytes - chunk.size()));
      chunk.insert(chunk.end(), part.begin(), part.end());
      this->Offset += std::ssize(part);
      bytes = bytes.subspan(part.size());
      if (chunk.size() == this->ChunkBytes)
      {
        this->Pending.submit();
        this->Current = nullptr;
      }
    }
  }
  /** Writes the last bytes, and waits until all are written. */
  void flush()
  {
    const WaitClock clock;
    this->Pending.takeAll();
    if (this->Current)
    {
      this->write(*this->Current); // a small file needs no thread
      this->Current = nullptr;
    }
    this->Waited += clock.nanoseconds();
  }
  /** The error number of the first write that failed, or 0. After it, nothing more is written. */
  int failed() const { return this->FirstError; }

private:
  /** One that is filled, and two that wait or are being written. */
  static constexpr std::size_t Chunks = 3;
  struct Chunk
  {
    std::vector<std::byte> bytes;
    std::int64_t offset = 0;
  };

  void write(const Chunk& chunk)
  {
    const int error = this->FirstError == 0 ? this->File.tryWrite(chunk.offset, chunk.bytes) : 0;
    int none = 0;
    this->FirstError.compare_exchange_strong(none, error);
  }

  const FileDescriptor& File;
  std::int64_t Offset;
  const std::size_t ChunkBytes;
  std::int64_t Waited = 0;
  Chunk* Current = nullptr; ///< that is filled; null: none yet
  std::atomic<int> FirstError{ 0 };
  Workers Threads{ 2 };
  OrderedJobs<Chunk> Pending;
};

} // namespace smg
