// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"
#include "IO/External/Workspace.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace smg
{

/** Rows of a sequence that another thread produces while the owner takes earlier ones. */
template <class Row>
class RowPrefetch
{
  static_assert(std::is_trivially_copyable_v<Row>);

public:
  /** Fills the span with the next rows; returns their number, fewer only at the end. It must not
   * submit jobs. */
  using Produce = std::function<std::size_t(std::span<Row>)>;

  static constexpr std::size_t MemoryBytes = std::size_t(128) << 10;
  static_assert(sizeof(Row) <= MemoryBytes / 2);

  /** Takes `memory` bytes, at least two rows, of the workspace, which must outlive it. */
  RowPrefetch(Workspace& workspace, Produce produce, std::size_t memory = MemoryBytes)
    : Space(workspace)
    , Taken(workspace.pool(), memory / 2)
    , Produced(workspace.pool(), memory / 2)
    , Production(workspace.workers(),
        [this, next = std::move(produce)] { this->ProducedRows = next(rows(this->Produced)); })
  {
    this->Production.submit();
  }

  /** The next row; returns false at the end. Rethrows an exception of the production; throws
   * Cancelled. */
  bool next(Row& row)
  {
    if (this->At == this->Count && !this->turn())
    {
      return false;
    }
    row = rows(this->Taken)[this->At++];
    return true;
  }
  /** The next rows, at most `most`, valid until the next call; none at the end. Throws the same. */
  std::span<const Row> some(std::size_t most)
  {
    if (this->At == this->Count && !this->turn())
    {
      return {};
    }
    const std::size_t count = std::min(most, this->Count - this->At);
    this->At += count;
    return rows(this->Taken).subspan(this->At - count, count);
  }

private:
  static std::span<Row> rows(Buffer& buffer)
  {
    return { reinterpret_cast<Row*>(buffer.data()), buffer.size() / sizeof(Row) };
  }

  /** Takes what was produced; returns whether there is any. */
  bool turn()
  {
    if (!this->Production.isPending())
    {
      return false;
    }
    this->Production.finish();
    this->Space.poll(); // which the production, on another thread, cannot
    std::swap(this->Taken, this->Produced);
    this->At = 0;
    this->Count = this->ProducedRows;
    if (this->Count == rows(this->Taken).size())
    {
      this->Production.submit();
    }
    return this->Count > 0;
  }

  Workspace& Space;
  Buffer Taken, Produced;
  std::size_t At = 0, Count = 0, ProducedRows = 0;
  Workers::Job Production;
};

/**
 * External merge sort in a given memory: put() all rows, then sort(), then next() delivers them in
 * order. Runs that fill the memory are sorted, written to scratch files and merged; rows that fit
 * into the memory need no files. The number of files stays small, since runs of a rank are merged
 * to one of the next rank while rows arrive.
 *
 * `Rows` is the type of rows: RecordRows (ExternalSort) for records of a type, or KeyedRows
 * (RowSort) for bytes with a key. Records that come from files are merged ahead on another thread.
 */
template <class Rows>
class MergeSort
{
public:
  using Key = typename Rows::Key; ///< of put()
  using Row = typename Rows::Row; ///< of next()

  /** Uses about `memory` bytes, at least 1 MiB, of the workspace's pool. */
  MergeSort(Workspace& workspace, std::int64_t memory, Rows rows = {})
    : Space(workspace)
    , Memory(static_cast<std::size_t>(std::max<std::int64_t>(memory, std::int64_t(1) << 20)))
    , Collected(std::move(rows))
  {
  }
  MergeSort(const MergeSort&) = delete;
  MergeSort& operator=(const MergeSort&) = delete;

  std::int64_t size() const { return this->Size; }

  /** Returns the result of put() of the rows. Throws Error. */
  auto put(const Key& key)
  {
    if (this->Used == this->Capacity)
    {
      this->makeRoom();
    }
    ++this->Size;
    return this->Collected.put(this->Used++, key);
  }

  /** To be called after the last put(). */
  void sort()
  {
    if (this->Runs.empty())
    {
      this->Collected.sort(this->Space.workers(), this->Used);
      return;
    }
    this->writeRun();
    this->release();
    while (this->Runs.size() > this->maxRuns())
    {
      this->mergeLast(std::min(this->maxRuns(), this->Runs.size() - this->maxRuns() + 1));
    }
    this->startMerge(this->Runs);
    if constexpr (Rows::AreWhole)
    {
      this->mergeAhead();
    }
  }

  /** The next row in order, valid until the next call; returns false at the end. */
  bool next(Row& row)
  {
    if constexpr (Rows::AreWhole)
    {
      if (this->Merged)
      {
        const bool isRow = this->Merged->next(row);
        if (!isRow)
        {
          this->Merged.reset();
        }
        return isRow;
      }
    }
    if (!this->Runs.empty())
    {
      return this->nextMerged(row);
    }
    if (this->Delivered == this->Used)
    {
      this->release();
      this->Used = this->Delivered = 0;
      return false;
    }
    row = this->Collected.get(this->Delivered++);
    return true;
  }

private:
  static constexpr std::size_t MinBufferBytes = std::size_t(64) << 10;
  /** The maximum number of runs of a rank that are merged at once while rows arrive. */
  static constexpr std::size_t RunsOfRank = 32;

  std::size_t bufferBytes() const { return std::max(MinBufferBytes, this->Collected.bytes()); }

  /** The number of runs that can be merged at once, with a chunk of the output file. */
  std::size_t maxRuns() const
  {
    return std::max<std::size_t>(2, (this->Memory - BucketFile::ChunkBytes) / this->bufferBytes());
  }

  void makeRoom()
  {
    // The memory of the first run grows with the data.
    const std::size_t most = std::max<std::size_t>(1, this->Memory / this->Collected.bytes());
    const std::size_t grown = std::min(most, std::max<std::size_t>(1024, this->Capacity * 4));
    if (this->Capacity == most)
    {
      this->writeRun();
    }
    if (this->Capacity < most)
    {
      this->Capacity = this->Runs.empty() ? grown : most;
      this->Collected.grow(this->Space.pool(), this->Capacity);
    }
  }

  void release()
  {
    this->Collected.release();
    this->Capacity = 0;
  }

  void writeRun()
  {
    if (this->Used == 0)
    {
      return;
    }
    this->Collected.sort(this->Space.workers(), this->Used);
    BucketFile& run = this->Runs.emplace_back(this->Space);
    for (std::size_t i = 0; i < this->Used; ++i)
    {
      this->Collected.write(this->Collected.get(i), run);
    }
    run.close();
    this->Ranks.push_back(0);
    this->Used = 0;
    const std::size_t count = std::min(this->maxRuns(), RunsOfRank);
    while (
      this->Ranks.size() >= count && this->Ranks[this->Ranks.size() - count] == this->Ranks.back())
    {
      this->release();
      this->mergeLast(count);
    }
  }

  /** Merges the last runs into one. */
  void mergeLast(std::size_t count)
  {
    const auto begin = this->Runs.end() - static_cast<std::ptrdiff_t>(count);
    this->startMerge(std::span(begin, this->Runs.end()));
    BucketFile longer(this->Space);
    for (Row row; this->nextMerged(row);)
    {
      this->Collected.write(row, longer);
    }
    longer.close();
    this->Runs.erase(begin, this->Runs.end());
    this->Runs.push_back(std::move(longer));
    this->Ranks.resize(this->Runs.size());
    ++this->Ranks.back();
  }

  void startMerge(std::span<const BucketFile> runs)
  {
    this->Readers.reserve(runs.size());
    this->Heads.resize(runs.size());
    for (const BucketFile& run : runs)
    {
      const std::size_t number = this->Readers.size();
      this->Readers.emplace_back(run, 0, this->bufferBytes());
      this->Collected.read(this->Readers.back(), this->Heads[number]);
      this->Heap.push_back(static_cast<std::uint32_t>(number));
    }
    for (std::size_t i = this->Heap.size() / 2; i-- > 0;)
    {
      this->sink(i);
    }
  }

  void mergeAhead()
  {
    if (this->Space.workers().threads() == 1 || Workers::isCaller())
    {
      return;
    }
    // In the memory of the chunk that mergeLast() needs.
    static_assert(RowPrefetch<Row>::MemoryBytes <= BucketFile::ChunkBytes);
    // Readers that fetch ahead submit jobs, which a job must not: their buffers must be too small
    // for it.
    static_assert(
      MinBufferBytes < BucketFile::MinAheadBytes && sizeof(Row) < BucketFile::MinAheadBytes);
    this->Merged = std::make_unique<RowPrefetch<Row>>(this->Space,
      [this](std::span<Row> rows)
      {
        std::size_t count = 0;
        while (count < rows.size() && this->nextMerged(rows[count]))
        {
          ++count;
        }
        return count;
      });
  }

  bool nextMerged(Row& row)
  {
    if (this->TopIsDelivered)
    {
      this->replaceTop();
    }
    this->TopIsDelivered = !this->Heap.empty();
    if (this->Heap.empty())
    {
      this->Readers.clear();
      return false;
    }
    row = this->Heads[this->Heap.front()];
    return true;
  }

  /** Advances the run at the top to its next row; the current row becomes invalid. */
  void replaceTop()
  {
    const std::uint32_t top = this->Heap.front();
    if (!this->Collected.read(this->Readers[top], this->Heads[top]))
    {
      this->Heap.front() = this->Heap.back();
      this->Heap.pop_back();
    }
    this->sink(0);
  }

  /** Rows with equal keys keep the order of put(), in which their runs are. */
  bool isBefore(std::uint32_t a, std::uint32_t b) const
  {
    const Row& rowA = this->Heads[a];
    const Row& rowB = this->Heads[b];
    if (Rows::HaveTies && !this->Collected.isLess(rowB, rowA))
    {
      return this->Collected.isLess(rowA, rowB) || a < b;
    }
    return this->Collected.isLess(rowA, rowB);
  }

  /** Sifts the run at position `i` down. */
  void sink(std::size_t i)
  {
    const std::size_t count = this->Heap.size();
    if (i >= count)
    {
      return;
    }
    const std::uint32_t run = this->Heap[i];
    for (std::size_t child = 2 * i + 1; child < count; child = 2 * i + 1)
    {
      if (child + 1 < count && this->isBefore(this->Heap[child + 1], this->Heap[child]))
      {
        ++child;
      }
      if (!this->isBefore(this->Heap[child], run))
      {
        break;
      }
      this->Heap[i] = this->Heap[child];
      i = child;
    }
    this->Heap[i] = run;
  }

  Workspace& Space;
  std::size_t Memory;
  std::int64_t Size = 0;
  Rows Collected; ///< in memory
  std::size_t Capacity = 0, Used = 0, Delivered = 0;
  std::vector<BucketFile> Runs; ///< by descending rank, in the order of put()
  std::vector<int> Ranks;       ///< number of merges of the rows of a run
  std::vector<BucketFile::Reader> Readers;
  std::vector<Row> Heads;          ///< the next row of each run
  std::vector<std::uint32_t> Heap; ///< runs
  bool TopIsDelivered = false;
  std::unique_ptr<RowPrefetch<Row>> Merged; ///< null: next() merges
};

} // namespace smg
