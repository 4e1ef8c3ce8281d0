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
 * apply() to a file of numbers. That takes as many passes over the file as tables for all numbers
 * fit into the memory.
 */
class Relabelling
{
public:
  /** For numbers in [0, end). A table takes `memory` bytes or less. */
  Relabelling(Workspace& workspace, std::int64_t end, std::int64_t memory)
    : Space(workspace)
    , Table(workspace, end, sizeof(std::uint32_t), memory)
  {
  }

  void put(std::uint32_t from, std::uint32_t to)
  {
    this->Table.put(from, std::as_bytes(std::span<const std::uint32_t, 1>(&to, 1)));
  }

  /** Gives the memory of the pairs back: nothing is put now. */
  void close() { this->Table.close(); }

  /** Passes over the file of numbers that apply() will take: none for numbers that are not put. */
  int passes() const { return static_cast<int>(this->neededBuckets().size()); }

  /**
   * Gives the replaced numbers of `file` to `take`, records of `count` numbers one after the other,
   * in the file's order. What was never put becomes NoIndex. Not to be called twice.
   */
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
  /** Those of the table that are not empty, or the first one. */
  std::vector<int> neededBuckets() const;

  Workspace& Space;
  RowTable Table;
};

} // namespace smg
