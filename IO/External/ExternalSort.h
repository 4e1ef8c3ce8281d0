// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/BucketFile.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * Sorts any number of records in a given memory: put() all, then sort(), then next() delivers them
 * in order. Runs that fill the memory are sorted and go to a scratch file, from which they are
 * merged; records that fit are sorted in memory alone.
 *
 * `Less` is a strict order without ties, so that the result is determined.
 */
template <class Record, class Less = std::less<Record>>
class ExternalSort
{
  static_assert(std::is_trivially_copyable_v<Record>);

public:
  /** Uses about `memory` bytes, 1 MiB at least, of the workspace's pool. */
  ExternalSort(Workspace& workspace, std::int64_t memory, Less less = {})
    : Space(workspace)
    , Memory(std::max<std::int64_t>(memory, std::int64_t(1) << 20))
    , IsLess(less)
  {
  }
  ExternalSort(const ExternalSort&) = delete;
  ExternalSort& operator=(const ExternalSort&) = delete;

  std::int64_t size() const { return this->Size; }

  void put(const Record& record)
  {
    if (this->Used == this->Capacity)
    {
      this->makeRoom();
    }
    this->records()[this->Used++] = record;
    ++this->Size;
  }

  /** Ends the putting. */
  void sort()
  {
    if (this->Runs.empty())
    {
      this->sortRun();
      return;
    }
    this->writeRun();
    this->Run = Buffer();
    this->Capacity = 0;
    this->mergeTooMany();
    this->startMerge(this->Runs);
  }

  /** The next record in order; false at the end. */
  bool next(Record& record)
  {
    if (this->Runs.empty())
    {
      if (this->Delivered == this->Used)
      {
        this->Run = Buffer();
        this->Used = this->Delivered = 0;
        return false;
      }
      record = this->records()[this->Delivered++];
      return true;
    }
    return this->nextMerged(record);
  }

private:
  static constexpr std::size_t BufferBytes = std::size_t(64) << 10;

  /** A run that is being merged, and the record it has to offer. */
  struct Head
  {
    Record record;
    std::uint32_t run;
  };

  Record* records() { return reinterpret_cast<Record*>(this->Run.data()); }

  /** Runs that can be merged at once. */
  std::size_t mostRuns() const
  {
    return std::max<std::size_t>(2, static_cast<std::size_t>(this->Memory) / BufferBytes - 4);
  }

  void makeRoom()
  {
    // The memory of a run grows with what there is to sort.
    const auto most = static_cast<std::size_t>(this->Memory) / sizeof(Record);
    const std::size_t wanted = std::max<std::size_t>(1024, this->Capacity * 4);
    if (this->Runs.empty() && this->Capacity < most && wanted * 5 / 4 < most)
    {
      Buffer larger(this->Space.pool(), wanted * sizeof(Record));
      std::copy_n(this->records(), this->Used, reinterpret_cast<Record*>(larger.data()));
      this->Run = std::move(larger);
      this->Capacity = wanted;
      return;
    }
    this->writeRun();
    if (this->Capacity != most)
    {
      this->Run = Buffer();
      this->Run = Buffer(this->Space.pool(), most * sizeof(Record));
      this->Capacity = most;
    }
  }

  void sortRun() { std::sort(this->records(), this->records() + this->Used, this->IsLess); }

  void writeRun()
  {
    if (this->Used == 0)
    {
      return;
    }
    this->sortRun();
    this->Runs.emplace_back(this->Space);
    this->Runs.back().append(
      0, std::as_bytes(std::span<const Record>(this->records(), this->Used)));
    this->Runs.back().close();
    this->Ranks.push_back(0);
    this->Used = 0;
    this->mergeEqualRuns();
  }

  /**
   * Keeps the number of open files small while runs come: as many runs of a rank become one of the
   * next rank.
   */
  void mergeEqualRuns()
  {
    const std::size_t count = std::min<std::size_t>(this->mostRuns(), 32);
    while (
      this->Ranks.size() >= count && this->Ranks[this->Ranks.size() - count] == this->Ranks.back())
    {
      this->Run = Buffer();
      this->Capacity = 0;
      this->mergeLast(count);
    }
  }

  /** Merges the last runs into one. */
  void mergeLast(std::size_t count)
  {
    const auto begin = this->Runs.end() - std::ptrdiff_t(count);
    this->startMerge(std::span(begin, this->Runs.end()));
    BucketFile longer(this->Space);
    for (Record record; this->nextMerged(record);)
    {
      longer.put(0, record);
    }
    longer.close();
    this->Readers.clear();
    this->Runs.erase(begin, this->Runs.end());
    this->Runs.push_back(std::move(longer));
    this->Ranks.resize(this->Runs.size());
    ++this->Ranks.back();
  }

  /** Merges runs, the shortest ones, until there are few enough to be merged at once. */
  void mergeTooMany()
  {
    while (this->Runs.size() > this->mostRuns())
    {
      this->mergeLast(std::min(this->mostRuns(), this->Runs.size() - this->mostRuns() + 1));
    }
  }

  void startMerge(std::span<const BucketFile> runs)
  {
    this->Readers.clear();
    this->Heap.clear();
    for (const BucketFile& run : runs)
    {
      this->Readers.emplace_back(run, 0, BufferBytes);
      Head head{ {}, static_cast<std::uint32_t>(this->Heap.size()) };
      this->Readers.back().get(head.record);
      this->Heap.push_back(head);
    }
    for (std::size_t i = this->Heap.size() / 2; i-- > 0;)
    {
      this->sink(i);
    }
  }

  bool nextMerged(Record& record)
  {
    if (this->Heap.empty())
    {
      this->Readers.clear();
      return false;
    }
    record = this->Heap.front().record;
    if (!this->Readers[this->Heap.front().run].get(this->Heap.front().record))
    {
      this->Heap.front() = this->Heap.back();
      this->Heap.pop_back();
    }
    this->sink(0);
    return true;
  }

  /** Brings the head at place `i` down to where it belongs. */
  void sink(std::size_t i)
  {
    const std::size_t count = this->Heap.size();
    if (i >= count)
    {
      return;
    }
    const Head head = this->Heap[i];
    for (std::size_t child = 2 * i + 1; child < count; child = 2 * i + 1)
    {
      if (child + 1 < count && this->IsLess(this->Heap[child + 1].record, this->Heap[child].record))
      {
        ++child;
      }
      if (!this->IsLess(this->Heap[child].record, head.record))
      {
        break;
      }
      this->Heap[i] = this->Heap[child];
      i = child;
    }
    this->Heap[i] = head;
  }

  Workspace& Space;
  std::int64_t Memory;
  Less IsLess;
  std::int64_t Size = 0;
  Buffer Run; ///< records that are collected
  std::size_t Capacity = 0, Used = 0, Delivered = 0;
  std::vector<BucketFile> Runs; ///< of falling rank
  std::vector<int> Ranks;       ///< how often the records of a run were merged
  std::vector<BucketFile::Reader> Readers;
  std::vector<Head> Heap;
};

} // namespace smg
