// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/**
 * Brings rows of bytes into the order of their numbers, out of core: every number of [0, count) is
 * put() once, in any order, then the rows are read by ascending numbers. They are distributed to
 * buckets for ranges of numbers that fit the memory.
 */
class RowScatter
{
public:
  /** For `count` rows of `rowBytes` bytes, at least 1. Uses about `memory` bytes of the pool. */
  RowScatter(Workspace& workspace, std::int64_t count, std::size_t rowBytes, std::int64_t memory);

  std::size_t rowBytes() const { return this->RowBytes; }

  void put(std::uint32_t number, std::span<const std::byte> row)
  {
    const int bucket = static_cast<int>(number / this->Range);
    this->Buckets.put(bucket, number);
    this->Buckets.append(bucket, row);
  }

  /** The next rows, at most `most`: after the last put(). Empty at the end. */
  std::span<const std::byte> next(std::int64_t most);

private:
  void load(int bucket);

  Workspace& Space;
  std::int64_t Count;
  std::size_t RowBytes;
  std::uint32_t Range; ///< numbers of a bucket
  BucketFile Buckets;
  Buffer Rows; ///< of the bucket that is read
  int Loaded = -1;
  std::int64_t Next = 0;
};

} // namespace smg
