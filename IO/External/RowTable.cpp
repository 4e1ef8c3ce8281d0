// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/RowTable.h"

#include <algorithm>
#include <cstring>

namespace smg
{

namespace
{

/** Buckets of equal size, as few as the memory permits. */
std::uint32_t rangeOf(std::int64_t count, std::size_t rowBytes, std::int64_t memory)
{
  const std::int64_t most = std::max<std::int64_t>(memory / static_cast<std::int64_t>(rowBytes), 1);
  const std::int64_t buckets = std::max<std::int64_t>((count + most - 1) / most, 1);
  return static_cast<std::uint32_t>(std::max<std::int64_t>((count + buckets - 1) / buckets, 1));
}

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

} // namespace smg
