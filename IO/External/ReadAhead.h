// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/IoThread.h"
#include "Solver/Files/FileDescriptor.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/** Reads ranges of a file ahead of their use, on a separate thread. It keeps a few ranges; a new
 * one replaces the oldest. */
class ReadAhead
{
public:
  /** The number of ranges. */
  static constexpr int Ranges = 8;

  explicit ReadAhead(const FileDescriptor& file);
  ~ReadAhead();

  /** Starts to read `bytes` bytes at `offset`. Returns false and reads nothing if they are already
   * read or requested, or if all ranges are busy. */
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

} // namespace smg
