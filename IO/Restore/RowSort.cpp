// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Restore/RowSort.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

namespace smg
{

namespace
{

/** Bytes that are read of a run at once; more if a row needs more. */
constexpr std::size_t BufferBytes = std::size_t(64) << 10;

/** Runs that are open at once: each is a file. */
constexpr std::size_t MostOpenRuns = 128;

} // namespace

/** Delivers the rows of some runs in order. */
class RowSort::Merge
{
public:
  Merge(std::span<const Run> runs, std::size_t rowBytes)
    : RecordBytes(sizeof(std::uint64_t) + rowBytes)
  {
    this->Readers.reserve(runs.size());
    for (const Run& run : runs)
    {
      this->Readers.emplace_back(run.rows, 0, std::max(BufferBytes, this->RecordBytes));
      this->offer(static_cast<std::uint32_t>(this->Readers.size() - 1));
    }
  }

  /** The next row with its key before it, valid until the next call. */
  bool next(std::span<const std::byte>& record)
  {
    if (this->Last != NoRun)
    {
      this->offer(std::exchange(this->Last, NoRun));
    }
    if (this->Heap.empty())
    {
      return false;
    }
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    record = { this->Heap.back().record, this->RecordBytes };
    this->Last = this->Heap.back().run;
    this->Heap.pop_back();
    return true;
  }

private:
  static constexpr std::uint32_t NoRun = UINT32_MAX;

  /** What a run has to offer. */
  struct Head
  {
    std::uint64_t key;
    std::uint32_t run;
    const std::byte* record;

    /** Comes later: the heap's top is the least. */
    bool operator<(const Head& other) const
    {
      return this->key != other.key ? this->key > other.key : this->run > other.run;
    }
  };

  void offer(std::uint32_t run)
  {
    const std::span<const std::byte> record =
      this->Readers[run].next(this->RecordBytes, this->RecordBytes);
    if (!record.empty())
    {
      Head head{ 0, run, record.data() };
      std::memcpy(&head.key, record.data(), sizeof(head.key));
      this->Heap.push_back(head);
      std::push_heap(this->Heap.begin(), this->Heap.end());
    }
  }

  std::size_t RecordBytes;
  std::vector<BucketFile::Reader> Readers;
  std::vector<Head> Heap;
  std::uint32_t Last = NoRun; ///< run of the row that was delivered last
};

RowSort::RowSort(Workspace& workspace, std::int64_t memory, std::size_t rowBytes)
  : Space(workspace)
  , Memory(static_cast<std::size_t>(std::max<std::int64_t>(memory, std::int64_t(1) << 20)))
  , RowBytes(rowBytes)
{
}

RowSort::~RowSort() = default;

std::size_t RowSort::mostRuns() const
{
  const std::size_t buffer = std::max(BufferBytes, this->RowBytes + sizeof(std::uint64_t));
  return std::clamp<std::size_t>(this->Memory / buffer, 2, MostOpenRuns);
}

void RowSort::allocate(std::size_t rows)
{
  Buffer keys(this->Space.pool(), rows * sizeof(Key));
  Buffer bytes(this->Space.pool(), rows * this->RowBytes);
  if (this->Used > 0)
  {
    std::memcpy(keys.data(), this->Keys.data(), this->Used * sizeof(Key));
    std::memcpy(bytes.data(), this->Rows.data(), this->Used * this->RowBytes);
  }
  this->Keys = std::move(keys);
  this->Rows = std::move(bytes);
  this->Capacity = rows;
}

void RowSort::makeRoom()
{
  const std::size_t most =
    std::clamp<std::size_t>(this->Memory / (this->RowBytes + sizeof(Key)), 1, UINT32_MAX);
  // The memory of a run grows with what there is to sort; the old rows need theirs meanwhile.
  const std::size_t wanted = std::max<std::size_t>(1024, this->Capacity * 4);
  if (wanted + this->Capacity <= most)
  {
    this->allocate(wanted);
    return;
  }
  if (this->Used > 0)
  {
    this->writeRun();
  }
  this->allocate(most);
}

void RowSort::sortKeys()
{
  std::sort(this->keys(), this->keys() + this->Used,
    [](const Key& a, const Key& b) { return a.key != b.key ? a.key < b.key : a.place < b.place; });
}

/** Writes what is collected, gives its memory back, and merges where that is due. */
void RowSort::writeRun()
{
  this->sortKeys();
  this->Runs.push_back({ BucketFile(this->Space), 0 });
  BucketFile& file = this->Runs.back().rows;
  for (const Key& key : std::span(this->keys(), this->Used))
  {
    file.put(0, key.key);
    file.append(0, { this->Rows.data() + key.place * this->RowBytes, this->RowBytes });
  }
  file.close();
  this->Keys = Buffer();
  this->Rows = Buffer();
  this->Used = this->Capacity = 0;

  const std::size_t most = this->mostRuns();
  while (this->Runs.size() >= most &&
         this->Runs[this->Runs.size() - most].level == this->Runs.back().level)
  {
    this->mergeLast(most);
  }
}

/** Makes one of the last runs. */
void RowSort::mergeLast(std::size_t count)
{
  const auto first = this->Runs.end() - static_cast<std::ptrdiff_t>(count);
  Run longer{ BucketFile(this->Space), first->level + 1 };
  {
    Merge merge(std::span<const Run>(&*first, count), this->RowBytes);
    for (std::span<const std::byte> record; merge.next(record);)
    {
      longer.rows.append(0, record);
    }
  }
  longer.rows.close();
  this->Runs.erase(first, this->Runs.end());
  this->Runs.push_back(std::move(longer));
}

void RowSort::sort()
{
  const bool isSmall = this->Capacity * (this->RowBytes + sizeof(Key)) <= this->Memory / 4;
  if (this->Runs.empty() && isSmall)
  {
    this->sortKeys();
    return;
  }
  if (this->Used > 0)
  {
    this->writeRun();
  }
  const std::size_t most = this->mostRuns();
  while (this->Runs.size() > most)
  {
    this->mergeLast(std::min(most, this->Runs.size() - most + 1));
  }
}

bool RowSort::next(Row& row)
{
  if (this->Runs.empty())
  {
    if (this->Delivered == this->Used)
    {
      this->Keys = Buffer();
      this->Rows = Buffer();
      return false;
    }
    const Key& key = this->keys()[this->Delivered++];
    row = { key.key, this->Rows.data() + key.place * this->RowBytes };
    return true;
  }
  if (!this->Merged)
  {
    this->Merged = std::make_unique<Merge>(this->Runs, this->RowBytes);
  }
  std::span<const std::byte> record;
  if (!this->Merged->next(record))
  {
    return false;
  }
  std::memcpy(&row.key, record.data(), sizeof(row.key));
  row.bytes = record.data() + sizeof(row.key);
  return true;
}

} // namespace smg
