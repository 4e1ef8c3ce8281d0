// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace smg
{

namespace
{

constexpr std::size_t ChunkNumbers = std::size_t(16) << 10;

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
  std::vector<std::uint32_t> numbers, replaced;
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
    for (std::int64_t left = file.size(); left > 0;
         left -= static_cast<std::int64_t>(numbers.size()))
    {
      numbers.resize(static_cast<std::size_t>(
        std::min<std::int64_t>(left, static_cast<std::int64_t>(ChunkNumbers / count * count))));
      in.next(numbers);
      replaced.resize(numbers.size());
      if (before)
      {
        before->next(replaced);
      }
      else
      {
        std::fill(replaced.begin(), replaced.end(), NoIndex);
      }
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        if (numbers[i] >= first && numbers[i] - first < labels.size())
        {
          replaced[i] = labels[numbers[i] - first];
        }
      }
      last ? take(replaced) : next.put(std::span<const std::uint32_t>(replaced));
    }
    before.reset();
    done.emplace(std::move(next));
  }
}

} // namespace smg
