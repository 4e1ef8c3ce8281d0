// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"

#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

// Rows by their numbers, and numbers replaced by others, out of core.
//
// RowTable distributes rows to buckets, one for each range of numbers that fits into the memory,
// and then brings one bucket at a time into place: everything is written once and read once.
// Relabelling replaces the numbers of a file with such tables: one pass over the file for each
// table, which replaces the numbers of its range and copies the results of the passes before.
// Numbers are replaced in chunks on all threads and taken in the order of the file.

namespace smg
{
namespace
{

/** The numbers of a bucket: buckets of equal size, as few as the memory permits. */
std::uint32_t rangeOf(std::int64_t count, std::size_t rowBytes, std::int64_t memory)
{
  const std::int64_t most = std::max<std::int64_t>(memory / static_cast<std::int64_t>(rowBytes), 1);
  const std::int64_t buckets = std::max<std::int64_t>((count + most - 1) / most, 1);
  return static_cast<std::uint32_t>(std::max<std::int64_t>((count + buckets - 1) / buckets, 1));
}

constexpr std::size_t ChunkNumbers = std::size_t(16) << 10;

/** Numbers, and what replaces them. */
struct NumberChunk
{
  std::vector<std::uint32_t> numbers, replaced;
};
constexpr std::int64_t NumberChunkBytes = 2 * std::int64_t(ChunkNumbers * sizeof(std::uint32_t));

} // namespace

RowTable::RowTable(
  Workspace& workspace, std::int64_t count, std::size_t rowBytes, std::int64_t memory)
  : Space(workspace)
  , Count(count)
  , RowBytes(rowBytes)
  , Range(rangeOf(count, rowBytes, memory))
  , Buckets(workspace,
      static_cast<int>(std::max<std::int64_t>((count + this->Range - 1) / this->Range, 1)),
      std::min(memory / 3, std::int64_t(4) << 20))
{
}

void RowTable::load(int bucket)
{
  if (!this->Rows.data())
  {
    this->Rows = Buffer(this->Space.pool(), std::size_t(this->Range) * this->RowBytes);
  }
  // Rows that were not put have all bits set: NoIndex, if they are numbers.
  std::ranges::fill(this->Rows.bytes(), std::byte(0xff));
  this->Loaded = -1; // unless all of it can be read
  const std::size_t first = std::size_t(bucket) * this->Range;
  const std::size_t recordBytes = sizeof(std::uint32_t) + this->RowBytes;
  BucketFile::Reader records(
    this->Buckets, bucket, std::max(BucketFile::ChunkBytes / 4, recordBytes));
  for (auto bytes = records.next(recordBytes); !bytes.empty(); bytes = records.next(recordBytes))
  {
    for (std::size_t at = 0; at < bytes.size(); at += recordBytes)
    {
      std::uint32_t number = 0;
      std::memcpy(&number, &bytes[at], sizeof(number));
      // In the order of put(), so the last row of a number remains.
      std::memcpy(this->Rows.data() + (number - first) * this->RowBytes,
        &bytes[at + sizeof(number)], this->RowBytes);
    }
  }
  this->Loaded = bucket;
}

std::span<const std::byte> RowTable::read(std::int64_t first, std::int64_t most)
{
  const auto bucket = static_cast<int>(first / this->Range);
  if (bucket != this->Loaded)
  {
    this->load(bucket);
  }
  const std::int64_t place = first % this->Range;
  const std::int64_t rows = std::min({ most, this->Range - place, this->Count - first });
  return this->Rows.bytes().subspan(static_cast<std::size_t>(place) * this->RowBytes,
    static_cast<std::size_t>(rows) * this->RowBytes);
}

void RowTable::release()
{
  this->Rows = Buffer();
  this->Loaded = -1;
}

std::vector<int> Relabelling::neededBuckets() const
{
  std::vector<int> needed;
  for (int bucket = 0; bucket < this->Table.buckets(); ++bucket)
  {
    if (this->Table.hasRows(bucket))
    {
      needed.push_back(bucket);
    }
  }
  // At least one pass is needed to pass the numbers on.
  return needed.empty() ? std::vector<int>{ 0 } : needed;
}

void Relabelling::applyChunks(
  const RecordFile<std::uint32_t>& file, std::size_t count, const TakeChunk& take)
{
  const std::vector<int> buckets = this->neededBuckets();
  RowTable& table = this->Table;
  table.close();
  // The numbers that earlier passes have replaced; NoIndex elsewhere.
  std::optional<RecordFile<std::uint32_t>> done;
  for (const int bucket : buckets)
  {
    const std::uint32_t first = static_cast<std::uint32_t>(bucket) * table.range();
    const std::span<const std::byte> rows = table.read(first);
    const std::span labels(
      reinterpret_cast<const std::uint32_t*>(rows.data()), rows.size() / sizeof(std::uint32_t));
    // Only the last pass has all numbers, and passes them on instead of storing them.
    const bool last = bucket == buckets.back();
    RecordFile<std::uint32_t>::Reader in(file);
    std::optional<RecordFile<std::uint32_t>::Reader> before;
    if (done)
    {
      before.emplace(*done);
    }
    RecordFile<std::uint32_t> next(this->Space);
    const std::int64_t atOnce = this->Space.itemsAtOnce(NumberChunkBytes);
    const Reservation reserved(this->Space.pool(), (atOnce - 1) * NumberChunkBytes);
    OrderedJobs<NumberChunk> chunks(
      this->Space.workers(), static_cast<std::size_t>(atOnce),
      [first, labels](NumberChunk& chunk)
      {
        for (std::size_t i = 0; i < chunk.numbers.size(); ++i)
        {
          const std::uint32_t place = chunk.numbers[i] - first;
          if (place < labels.size())
          {
            // Each number is in the range of one table, so passes do not disturb each other.
            chunk.replaced[i] = labels[place];
          }
        }
      },
      [&](const NumberChunk& chunk)
      { last ? take(chunk.replaced) : next.put(std::span<const std::uint32_t>(chunk.replaced)); });
    for (std::int64_t left = file.size(); left > 0;)
    {
      auto& [numbers, replaced] = chunks.next();
      numbers.resize(static_cast<std::size_t>(
        std::min<std::int64_t>(left, static_cast<std::int64_t>(ChunkNumbers / count * count))));
      in.next(numbers);
      left -= std::ssize(numbers);
      replaced.assign(numbers.size(), NoIndex);
      if (before)
      {
        before->next(replaced);
      }
      chunks.submit();
    }
    chunks.takeAll();
    // The reader ends before its file is replaced.
    before.reset();
    done.emplace(std::move(next));
  }
  table.release();
}

} // namespace smg
