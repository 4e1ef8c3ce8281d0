// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/RowTable.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace smg
{

/** A number that stands for none. */
inline constexpr std::uint32_t NoIndex = std::numeric_limits<std::uint32_t>::max();

/**
 * Replaces numbers below a given end by others, out of core: put() the pairs in any order, then
 * apply() to a file of numbers. This takes a pass over the file for each table that fits into the
 * memory.
 */
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

  /** The number of passes of apply() over the file: none for tables without numbers. */
  int passes() const { return static_cast<int>(this->neededBuckets().size()); }

  /** Passes the replaced numbers of `file` to `take`, in records of `count` numbers, in the order
   * of the file. Numbers without a pair become NoIndex. To be called once. */
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
