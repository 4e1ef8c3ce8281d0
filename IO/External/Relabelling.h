// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/** A table of rows of bytes, out of core: put() rows by their numbers in any order, then read()
 * them by ascending number. Rows are distributed to buckets for ranges of numbers that fit into
 * the memory. */
class RowTable
{
public:
  /** For numbers in [0, count), with rows of `rowBytes` bytes, at least 1. The rows of a bucket use
   * at most `memory` bytes of the pool; the write buffers a third of that, at most 4 MiB. */
  RowTable(Workspace& workspace, std::int64_t count, std::size_t rowBytes, std::int64_t memory);

  std::int64_t count() const { return this->Count; }
  std::size_t rowBytes() const { return this->RowBytes; }

  /** The last row of a number replaces earlier ones. */
  void put(std::uint32_t number, std::span<const std::byte> row)
  {
    const int bucket = static_cast<int>(number / this->Range);
    this->Buckets.put(bucket, number);
    this->Buckets.append(bucket, row);
  }

  /** Releases the write buffers; to be called after the last put(). */
  void close() { this->Buckets.close(); }
  /** Releases the memory of the rows that were read last. */
  void release();

  /** The number of rows of a bucket. */
  std::uint32_t range() const { return this->Range; }
  int buckets() const { return this->Buckets.buckets(); }
  bool hasRows(int bucket) const { return this->Buckets.bytes(bucket) > 0; }

  /** The rows of the numbers from `first`, which is below count(), to the end of its bucket, but at
   * most `most`. To be called after close(); valid until the next call. Rows that were not put
   * have all bits set. */
  std::span<const std::byte> read(std::int64_t first, std::int64_t most = INT64_MAX);

private:
  void load(int bucket);

  Workspace& Space;
  std::int64_t Count;
  std::size_t RowBytes;
  std::uint32_t Range;
  BucketFile Buckets;
  Buffer Rows; ///< of the current bucket
  int Loaded = -1;
};

/** A number that stands for no vertex or row. */
inline constexpr std::uint32_t NoIndex = std::numeric_limits<std::uint32_t>::max();

/** Replaces numbers below a given end by others, out of core: put() the pairs in any order, then
 * apply() to a file of numbers. This takes a pass over the file for each table that fits into the
 * memory. */
class Relabelling
{
public:
  /** For numbers in [0, end). A table uses at most `memory` bytes. */
  Relabelling(Workspace& workspace, std::int64_t end, std::int64_t memory)
    : Space(workspace)
    , Table(workspace, end, sizeof(std::uint32_t), memory)
  {
  }

  void put(std::uint32_t from, std::uint32_t to)
  {
    this->Table.put(from, std::as_bytes(std::span<const std::uint32_t, 1>(&to, 1)));
  }

  /** Releases the memory of the pairs; to be called after the last put(). */
  void close() { this->Table.close(); }

  /** The number of passes of apply() over the file: one for each table that has numbers, but at
   * least one. */
  int passes() const { return static_cast<int>(this->neededBuckets().size()); }

  /** Passes the replaced numbers of `file` to `take`, in records of `count` numbers, in the order
   * of the file. Numbers without a pair become NoIndex. */
  template <class Take>
  void apply(const RecordFile<std::uint32_t>& file, std::size_t count, Take&& take)
  {
    this->applyChunks(file, count,
      [&take, count](std::span<const std::uint32_t> numbers)
      {
        for (std::size_t i = 0; i < numbers.size(); i += count)
        {
          take(numbers.subspan(i, count));
        }
      });
  }

private:
  using TakeChunk = std::function<void(std::span<const std::uint32_t>)>;

  void applyChunks(const RecordFile<std::uint32_t>& file, std::size_t count, const TakeChunk& take);
  /** The tables that are not empty, or the first one. */
  std::vector<int> neededBuckets() const;

  Workspace& Space;
  RowTable Table;
};

} // namespace smg
