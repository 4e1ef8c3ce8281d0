// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"

#include "IO/External/OrderedJobs.h"
#include "Solver/Memory/Reservation.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

constexpr std::size_t ChunkNumbers = std::size_t(16) << 10;

/** Numbers, and what replaces them. */
struct NumberChunk
{
  std::vector<std::uint32_t> numbers, replaced;
};
constexpr std::int64_t NumberChunkBytes = 2 * std::int64_t(ChunkNumbers * sizeof(std::uint32_t));

} // namespace

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
  return needed.empty() ? std::vector<int>{ 0 } : needed;
}

void Relabelling::applyChunks(
  const RecordFile<std::uint32_t>& file, std::size_t count, const TakeChunk& take)
{
  const std::vector<int> buckets = this->neededBuckets();
  RowTable table = std::move(this->Table); // whose memory is released afterwards
  table.close();
  // The numbers replaced by the passes so far; NoIndex elsewhere.
  std::optional<RecordFile<std::uint32_t>> done;
  for (const int bucket : buckets)
  {
    const std::uint32_t first = static_cast<std::uint32_t>(bucket) * table.range();
    const std::span<const std::byte> rows = table.read(first);
    const std::span labels(
      reinterpret_cast<const std::uint32_t*>(rows.data()), rows.size() / sizeof(std::uint32_t));
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
    before.reset();
    done.emplace(std::move(next));
  }
}

} // namespace smg
