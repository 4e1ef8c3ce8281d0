// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/MergeSort.h"
#include "IO/External/ParallelSort.h"

#include <cstddef>
#include <functional>
#include <type_traits>

namespace smg
{

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

} // namespace smg
