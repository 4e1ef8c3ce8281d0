// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/Relabelling.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace smg
{

namespace
{

constexpr std::size_t ChunkNumbers = std::size_t(16) << 10;

std::int64_t tableRange(std::int64_t end, std::int64_t memory)
{
  const std::int64_t most = std::max<std::int64_t>(memory / std::int64_t(sizeof(std::uint32_t)), 1);
  const std::int64_t passes = std::max<std::int64_t>((end + most - 1) / most, 1);
  return std::max<std::int64_t>((end + passes - 1) / passes, 1);
}

} // namespace

Relabelling::Relabelling(Workspace& workspace, std::int64_t end, std::int64_t memory)
  : Space(workspace)
  , Range(static_cast<std::uint32_t>(tableRange(end, memory)))
  , Pairs(workspace,
      static_cast<int>(std::max<std::int64_t>((end + this->Range - 1) / this->Range, 1)),
      std::int64_t(4) << 20)
{
}

void Relabelling::loadTable(int pass, std::span<std::uint32_t> table)
{
  std::fill(table.begin(), table.end(), NoIndex);
  const std::uint32_t first = static_cast<std::uint32_t>(pass) * this->Range;
  BucketFile::Reader pairs(this->Pairs, pass);
  for (std::uint32_t pair[2]; pairs.get(pair);)
  {
    table[pair[0] - first] = pair[1];
  }
}

std::vector<int> Relabelling::neededPasses() const
{
  std::vector<int> needed;
  for (int pass = 0; pass < this->Pairs.buckets(); ++pass)
  {
    if (this->Pairs.bytes(pass) > 0)
    {
      needed.push_back(pass);
    }
  }
  return needed.empty() ? std::vector<int>{ 0 } : needed;
}

void Relabelling::applyChunks(
  const RecordFile<std::uint32_t>& file, std::size_t count, const TakeChunk& take)
{
  this->Pairs.close();
  Buffer tableBytes(this->Space.pool(), std::size_t(this->Range) * sizeof(std::uint32_t));
  const std::span table(reinterpret_cast<std::uint32_t*>(tableBytes.data()), this->Range);
  // What the passes so far have replaced; NoIndex elsewhere.
  std::optional<RecordFile<std::uint32_t>> done;
  std::vector<std::uint32_t> numbers, replaced;
  const std::vector<int> passes = this->neededPasses();
  for (const int pass : passes)
  {
    this->loadTable(pass, table);
    const std::uint32_t first = static_cast<std::uint32_t>(pass) * this->Range;
    const bool last = pass == passes.back();
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
        if (numbers[i] >= first && numbers[i] - first < this->Range)
        {
          replaced[i] = table[numbers[i] - first];
        }
      }
      last ? take(replaced) : next.put(std::span<const std::uint32_t>(replaced));
    }
    before.reset();
    done.emplace(std::move(next));
  }
}

} // namespace smg
