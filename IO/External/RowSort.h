// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/MergeSort.h"
#include "IO/External/ParallelSort.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>

namespace smg
{

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

} // namespace smg
