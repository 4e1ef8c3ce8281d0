// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/MergeSort.h"
#include "Solver/Core/Workers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <tuple>
#include <type_traits>
#include <vector>

namespace smg
{

namespace parallelsort
{

/** Fewer records are sorted by one thread. */
inline constexpr std::ptrdiff_t MinRecords = 1 << 14;

/** Moves the records before the median of a sample to the front; returns their end. */
template <class Record, class Less>
Record* divide(Record* begin, Record* end, const Less& less)
{
  std::array<Record, 31> sample;
  const std::ptrdiff_t step = (end - begin) / std::ssize(sample);
  for (std::ptrdiff_t i = 0; i < std::ssize(sample); ++i)
  {
    sample[static_cast<std::size_t>(i)] = begin[i * step];
  }
  const auto middle = sample.begin() + sample.size() / 2;
  std::nth_element(sample.begin(), middle, sample.end(), less);
  return std::partition(begin, end, [&](const Record& record) { return less(record, *middle); });
}

} // namespace parallelsort

/** Sorts records by `less`, a strict order without ties, so that the result is unique: quicksort,
 * whose parts are divided further and sorted on all threads. */
template <class Record, class Less>
void parallelSort(Workers& workers, Record* begin, Record* end, Less less)
{
  std::vector<Record*> ends{ begin, end }; // of the parts
  const auto parts = [&ends] { return static_cast<int>(ends.size()) - 1; };
  const int wanted = workers.threads() > 1 ? 2 * workers.threads() : 1;
  while (parts() < wanted && (end - begin) / parts() >= 2 * parallelsort::MinRecords)
  {
    std::vector<Record*> divided(ends.size() + static_cast<std::size_t>(parts()), end);
    runAll(workers, parts(),
      [&](int part)
      {
        const auto p = static_cast<std::size_t>(part);
        divided[2 * p] = ends[p];
        divided[2 * p + 1] = ends[p + 1] - ends[p] < parallelsort::MinRecords
                               ? ends[p + 1]
                               : parallelsort::divide(ends[p], ends[p + 1], less);
      });
    ends = std::move(divided);
  }
  runAll(workers, parts(),
    [&](int part)
    {
      const auto p = static_cast<std::size_t>(part);
      std::sort(ends[p], ends[p + 1], less);
    });
}

/** Rows for a MergeSort that are records of a type. */
template <class Record, class Less>
class RecordRows
{
  static_assert(std::is_trivially_copyable_v<Record>);

public:
  using Key = Record;
  using Row = Record;
  static constexpr bool HaveTies = false;
  static constexpr bool AreWhole = true; ///< a Row has its bytes

  RecordRows(Less less = {})
    : IsLess(less)
  {
  }

  std::size_t bytes() const { return sizeof(Record); }
  void grow(Pool& pool, std::size_t count) { this->Records.grow(pool, count * sizeof(Record)); }
  void release() { this->Records = Buffer(); }
  void put(std::size_t place, const Record& record) { this->records()[place] = record; }
  const Record& get(std::size_t place) const { return this->records()[place]; }
  void sort(Workers& workers, std::size_t count)
  {
    parallelSort(workers, this->records(), this->records() + count, this->IsLess);
  }

  bool isLess(const Record& a, const Record& b) const { return this->IsLess(a, b); }
  void write(const Record& record, BucketFile& run) const { run.put(0, record); }
  bool read(BucketFile::Reader& run, Record& record) const { return run.get(record); }

private:
  Record* records() const { return reinterpret_cast<Record*>(this->Records.data()); }

  Less IsLess;
  Buffer Records;
};

/** Sorts records by `Less`, a strict order without ties, so that the result is unique. */
template <class Record, class Less = std::less<Record>>
using ExternalSort = MergeSort<RecordRows<Record, Less>>;

/** Rows for a MergeSort with a key and a number of bytes that is known at run time. */
class KeyedRows
{
public:
  using Key = std::uint64_t;
  struct Row
  {
    std::uint64_t key = 0;
    const std::byte* bytes = nullptr;
  };
  static constexpr bool HaveTies = true;
  static constexpr bool AreWhole = false;

  KeyedRows(std::size_t rowBytes)
    : RowBytes(rowBytes)
  {
  }

  std::size_t bytes() const { return sizeof(Place) + this->RowBytes; }
  void grow(Pool& pool, std::size_t count)
  {
    this->Places.grow(pool, count * sizeof(Place));
    this->Rows.grow(pool, count * this->RowBytes);
  }
  void release()
  {
    this->Places = Buffer();
    this->Rows = Buffer();
  }
  /** The destination of the bytes of the row, valid until the next put(). */
  std::byte* put(std::size_t place, std::uint64_t key)
  {
    this->places()[place] = { key, place };
    return this->row(place);
  }
  Row get(std::size_t place) const
  {
    const Place& sorted = this->places()[place];
    return { sorted.key, this->row(sorted.place) };
  }
  void sort(Workers& workers, std::size_t count)
  {
    parallelSort(workers, this->places(), this->places() + count,
      [](const Place& a, const Place& b)
      { return std::tie(a.key, a.place) < std::tie(b.key, b.place); });
  }

  bool isLess(const Row& a, const Row& b) const { return a.key < b.key; }
  void write(const Row& row, BucketFile& run) const
  {
    run.put(0, row.key);
    run.append(0, { row.bytes, this->RowBytes });
  }
  bool read(BucketFile::Reader& run, Row& row) const
  {
    const std::size_t bytes = sizeof(row.key) + this->RowBytes;
    const std::span<const std::byte> next = run.next(bytes, bytes);
    if (next.empty())
    {
      return false;
    }
    std::memcpy(&row.key, next.data(), sizeof(row.key));
    row.bytes = next.data() + sizeof(row.key);
    return true;
  }

private:
  struct Place
  {
    std::uint64_t key;
    std::uint64_t place; ///< of the bytes
  };

  Place* places() const { return reinterpret_cast<Place*>(this->Places.data()); }
  std::byte* row(std::size_t place) const { return this->Rows.data() + place * this->RowBytes; }

  std::size_t RowBytes;
  Buffer Places, Rows;
};

/** Sorts rows of bytes by a number; stable for equal numbers. */
using RowSort = MergeSort<KeyedRows>;

/** Bytes of the files of a RowSort of this many rows: none if they fit into its memory with their
 * keys and places. */
inline std::int64_t rowSortBytes(std::int64_t rows, std::int64_t rowBytes, std::int64_t memory)
{
  constexpr std::int64_t KeyBytes = sizeof(KeyedRows::Key), PlaceBytes = sizeof(std::uint64_t);
  return rows * (KeyBytes + PlaceBytes + rowBytes) > memory ? rows * (KeyBytes + rowBytes) : 0;
}

} // namespace smg
