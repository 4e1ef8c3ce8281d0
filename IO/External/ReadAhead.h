// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <pthread.h>
#include <span>
#include <vector>

namespace smg
{

/** A thread for disk work or for Workers. Its stack is small and its function should allocate no
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

/** Reads ranges of a file ahead of their use, on a thread of its own. It keeps a few ranges; a new
 * one replaces the oldest. */
class ReadAhead
{
public:
  /** The number of ranges. */
  static constexpr int Ranges = 8;

  explicit ReadAhead(const FileDescriptor& file);
  ~ReadAhead();

  /** Starts to read `bytes` bytes at `offset`. Returns false, and reads nothing, if they are
   * already read or requested, or all ranges are busy. */
  bool request(std::int64_t offset, std::size_t bytes);
  /**
   * The `bytes` bytes at `offset`, after waiting for a pending read; nothing if they are not part
   * of a requested range, if that has been replaced, or if it could not be read. Valid until the
   * next request().
   */
  std::optional<std::span<const std::byte>> find(std::int64_t offset, std::size_t bytes);
  /** Releases the range that ends at `end`. */
  void release(std::int64_t end);
  /** Total nanoseconds in which find() waited. */
  std::int64_t waitNanoseconds() const { return this->Waited; }

private:
  enum class State
  {
    Free,
    Queued,
    Reading,
    Ready,
    Failed
  };
  struct Range
  {
    State state = State::Free;
    std::int64_t offset = -1;
    std::size_t size = 0;
    std::uint64_t age = 0;
    std::vector<std::byte> bytes; ///< at least `size`; grows only

    std::int64_t end() const { return this->offset + static_cast<std::int64_t>(this->size); }
  };

  void run();
  /** The range that holds these bytes. */
  Range* lookUp(std::int64_t offset, std::size_t bytes);
  Range* oldestQueued();

  const FileDescriptor& File;
  std::int64_t Waited = 0;
  std::uint64_t Requests = 0;

  std::mutex Mutex;
  std::condition_variable Changed;
  std::array<Range, Ranges> Kept;
  bool Stop = false;

  IoThread Thread;
};

/** Writes bytes to a file one after another, on a thread of its own. The bytes are copied into a
 * few chunks of memory; the caller waits only if all chunks are pending. */
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
