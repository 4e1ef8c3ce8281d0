// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/IoThread.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace smg
{

/** Writes bytes to a file sequentially, on a separate thread. The bytes are copied into a few
 * chunks of memory; the caller waits only if all chunks are pending. */
class SMG_EXPORT WriteBehind
{
public:
  /** Writes from `offset` on, with chunks of `bytes` bytes in total. The file must outlive it. */
  WriteBehind(const FileDescriptor& file, std::int64_t offset, std::size_t bytes);
  /** Ends the thread; bytes that were not flushed are not written. */
  ~WriteBehind();

  /** The file offset of the next byte. */
  std::int64_t offset() const { return this->Offset; }
  /** Total nanoseconds in which put() and flush() waited. */
  std::int64_t waitNanoseconds() const { return this->Waited; }

  /** Appends bytes. A failed write is not thrown but reported by failed(). */
  void put(std::span<const std::byte> bytes);
  /** Waits until all bytes are written. */
  void flush();
  /** The error number of the first write that failed, or 0. */
  int failed();

private:
  static constexpr int Chunks = 3;
  struct Chunk
  {
    std::vector<std::byte> bytes;
    std::size_t used = 0;
    std::int64_t offset = 0;
  };

  void run();
  void handOver();
  template <class Condition>
  void waitUntil(std::unique_lock<std::mutex>& lock, Condition condition);

  const FileDescriptor& File;
  std::int64_t Offset;
  std::int64_t Waited = 0;
  std::array<Chunk, Chunks> Ring;
  int Current = 0; ///< the chunk being filled, not accessed by the thread

  std::mutex Mutex;
  std::condition_variable Changed;
  int Full = 0; ///< number of chunks waiting to be written, before Current
  int FirstError = 0;
  bool Stop = false;

  IoThread Thread;
};

} // namespace smg
