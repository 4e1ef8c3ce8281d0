// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/RowScatter.h"

#include <algorithm>

namespace smg
{

namespace
{

std::int64_t rowsOfBucket(std::int64_t count, std::size_t rowBytes, std::int64_t memory)
{
  const std::int64_t most =
    std::max<std::int64_t>(memory * 3 / 4 / static_cast<std::int64_t>(rowBytes), 1);
  const std::int64_t buckets = std::max<std::int64_t>((count + most - 1) / most, 1);
  return std::max<std::int64_t>((count + buckets - 1) / buckets, 1);
}

} // namespace

RowScatter::RowScatter(
  Workspace& workspace, std::int64_t count, std::size_t rowBytes, std::int64_t memory)
  : Space(workspace)
  , Count(count)
  , RowBytes(rowBytes)
  , Range(static_cast<std::uint32_t>(rowsOfBucket(count, rowBytes, memory)))
  , Buckets(workspace,
      static_cast<int>(std::max<std::int64_t>((count + this->Range - 1) / this->Range, 1)),
      memory / 4)
{
}

void RowScatter::load(int bucket)
{
  if (this->Loaded < 0)
  {
    this->Buckets.close();
    this->Rows = Buffer(this->Space.pool(), std::size_t(this->Range) * this->RowBytes);
  }
  this->Loaded = bucket;
  const std::size_t first = std::size_t(bucket) * this->Range;
  BucketFile::Reader records(this->Buckets, bucket,
    std::max(BucketFile::ChunkBytes / 4, sizeof(std::uint32_t) + this->RowBytes));
  const std::size_t recordBytes = sizeof(std::uint32_t) + this->RowBytes;
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
}

std::span<const std::byte> RowScatter::next(std::int64_t most)
{
  if (this->Next == this->Count)
  {
    this->Rows = Buffer();
    return {};
  }
  const auto bucket = static_cast<int>(this->Next / this->Range);
  if (bucket != this->Loaded)
  {
    this->load(bucket);
  }
  const std::int64_t place = this->Next % this->Range;
  const std::int64_t rows = std::min({ most, this->Range - place, this->Count - this->Next });
  this->Next += rows;
  return this->Rows.bytes().subspan(static_cast<std::size_t>(place) * this->RowBytes,
    static_cast<std::size_t>(rows) * this->RowBytes);
}

} // namespace smg
