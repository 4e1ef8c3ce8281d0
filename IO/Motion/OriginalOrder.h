// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

namespace smg
{

/**
 * Brings tuples into the order of their numbers, out of core: they are put in any order and read by
 * number. They are distributed to buckets, each for a range of the numbers that fits the memory;
 * what is more than that goes to a scratch file that has no name.
 */
class OriginalOrder
{
public:
  /** Least memory that is used. */
  static constexpr std::int64_t LeastMemory = std::int64_t(8) << 20;

  /**
   * For tuples of `tupleBytes` bytes, 1 to 1000. Uses at most `memory` bytes of memory, at least
   * LeastMemory; the scratch file goes to `scratch` (empty: the system's temporary folder).
   */
  OriginalOrder(std::size_t tupleBytes, std::filesystem::path scratch, std::int64_t memory);

  /**
   * Takes the tuple of each of the numbers, which are at least 0. Of several tuples with one number
   * the last counts. Not to be called after read(). Throws Error.
   */
  void put(std::span<const std::int64_t> ids, std::span<const std::byte> tuples);

  /** The largest number that was put, plus 1. */
  std::int64_t end() const { return this->End; }

  /**
   * Writes the tuples of the numbers [first, first + given.size()) to `tuples`, and to `given` 1
   * for each that was put; the others are left as they are. Any range in any order; ascending
   * ranges read the scratch file once. Throws Error.
   */
  void read(std::int64_t first, std::span<std::uint8_t> given, std::span<std::byte> tuples);

private:
  /** Where records of a bucket stand in the file. */
  struct Run
  {
    std::int64_t offset;
    std::size_t bytes;
  };
  /** The tuples of a range of the numbers, as records: place in the range, tuple. */
  struct Bucket
  {
    std::vector<Run> runs;
    std::vector<std::uint32_t> chunks; ///< with records that are not in the file
    std::size_t used = 0;              ///< bytes of the last chunk
  };

  std::byte* newRecord(Bucket& bucket);
  std::span<const std::byte> chunk(const Bucket& bucket, std::size_t i) const;
  void spill();
  void load(std::int64_t number);
  void take(std::span<const std::byte> records);

  std::size_t TupleBytes;
  std::filesystem::path Scratch;
  std::int64_t Range; ///< numbers a bucket
  std::int64_t End = 0;
  std::map<std::int64_t, Bucket> Buckets;
  std::size_t ChunkBytes;
  std::vector<std::byte> Chunks; ///< one after the other
  std::size_t NextChunk = 0, MostChunks;
  FileDescriptor File;
  std::int64_t FileEnd = 0;

  std::int64_t Loaded = -1; ///< the bucket whose tuples are in memory
  std::vector<std::byte> Tuples;
  std::vector<std::uint8_t> Given;
};

} // namespace smg
