// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"
#include "Solver/Storage/IoThread.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace smg
{

/**
 * Reads ranges of a file before they are wanted, on a thread of its own. It keeps a few ranges: the
 * oldest gives way to a new one.
 */
class ReadAhead
{
public:
  /** Ranges that are kept. */
  static constexpr int Ranges = 8;

  explicit ReadAhead(const FileDescriptor& file);
  ~ReadAhead();

  /**
   * Begins to read `bytes` bytes at `offset`. False if they are there, or on their way, or all
   * ranges are in work: then nothing is read.
   */
  bool request(std::int64_t offset, std::size_t bytes);
  /**
   * The `bytes` bytes at `offset`, waited for if they are on their way; nothing if they are no part
   * of a range that was requested, that has given way, or could not be read. Valid until the next
   * request().
   */
  std::optional<std::span<const std::byte>> find(std::int64_t offset, std::size_t bytes);
  /** Gives up the range that ends at `end`: it is not wanted any more. */
  void release(std::int64_t end);
  /** Nanoseconds that find() stood waiting, in all. */
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
