// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Motion/OriginalOrder.h"

#include "Solver/Storage/ScratchFolder.h"
#include "smg/Error.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <utility>

namespace smg
{

namespace
{

/** The place of a tuple within the range of its bucket. */
using Place = std::uint32_t;

/** About so many bytes of records are kept for a bucket, or a multiple. */
constexpr std::size_t ChunkSize = 1024;

/** About so many bytes are read from the scratch file, or written to it, at once. */
constexpr std::size_t TransferBytes = std::size_t(256) << 10;

} // namespace

OriginalOrder::OriginalOrder(
  std::size_t tupleBytes, std::filesystem::path scratch, std::int64_t memory)
  : TupleBytes(tupleBytes)
  , Scratch(std::move(scratch))
  , ChunkBytes(ChunkSize / (sizeof(Place) + tupleBytes) * (sizeof(Place) + tupleBytes))
{
  // A half for the tuples of the bucket that is read, a quarter for records that wait.
  const std::int64_t most = std::max(memory, LeastMemory);
  this->Range =
    std::clamp<std::int64_t>(most / 2 / static_cast<std::int64_t>(tupleBytes + 1), 1, UINT32_MAX);
  this->MostChunks = static_cast<std::size_t>(most) / 4 / this->ChunkBytes;
}

void OriginalOrder::put(std::span<const std::int64_t> ids, std::span<const std::byte> tuples)
{
  assert(tuples.size() == ids.size() * this->TupleBytes);
  std::int64_t number = -1;
  Bucket* bucket = nullptr;
  const std::byte* tuple = tuples.data();
  for (const std::int64_t id : ids)
  {
    if (id < 0)
    {
      throw Error("The original number " + std::to_string(id) +
                  " of a vertex is negative: the mesh must be the one that was made of the file.");
    }
    if (!bucket || id / this->Range != number)
    {
      number = id / this->Range;
      bucket = &this->Buckets[number];
    }
    const auto place = static_cast<Place>(id % this->Range);
    std::byte* const record = this->newRecord(*bucket);
    std::memcpy(record, &place, sizeof(place));
    std::memcpy(record + sizeof(place), tuple, this->TupleBytes);
    tuple += this->TupleBytes;
    this->End = std::max(this->End, id + 1);
  }
}

/** Room for a record of the bucket. */
std::byte* OriginalOrder::newRecord(Bucket& bucket)
{
  if (bucket.chunks.empty() || bucket.used == this->ChunkBytes)
  {
    if (this->NextChunk == this->MostChunks)
    {
      this->spill();
    }
    bucket.chunks.push_back(static_cast<std::uint32_t>(this->NextChunk++));
    bucket.used = 0;
    if (this->Chunks.size() < this->NextChunk * this->ChunkBytes)
    {
      this->Chunks.reserve(this->MostChunks * this->ChunkBytes);
      this->Chunks.resize(this->NextChunk * this->ChunkBytes);
    }
  }
  std::byte* const record = &this->Chunks[bucket.chunks.back() * this->ChunkBytes + bucket.used];
  bucket.used += sizeof(Place) + this->TupleBytes;
  return record;
}

/** The records of a chunk of the bucket. */
std::span<const std::byte> OriginalOrder::chunk(const Bucket& bucket, std::size_t i) const
{
  return std::span(this->Chunks)
    .subspan(bucket.chunks[i] * this->ChunkBytes,
      i + 1 < bucket.chunks.size() ? this->ChunkBytes : bucket.used);
}

/** Writes all waiting records to the scratch file. */
void OriginalOrder::spill()
{
  if (!this->File.isOpen())
  {
    const ScratchFolder folder(this->Scratch);
    this->File = FileDescriptor::createNameless(folder.path());
  }
  std::vector<std::byte> bytes;
  bytes.reserve(TransferBytes);
  const auto write = [&]
  {
    this->File.write(this->FileEnd, bytes);
    this->FileEnd += static_cast<std::int64_t>(bytes.size());
    bytes.clear();
  };
  for (auto& [number, bucket] : this->Buckets)
  {
    const auto offset = this->FileEnd + static_cast<std::int64_t>(bytes.size());
    std::size_t size = 0;
    for (std::size_t i = 0; i < bucket.chunks.size(); ++i)
    {
      const std::span<const std::byte> records = this->chunk(bucket, i);
      bytes.insert(bytes.end(), records.begin(), records.end());
      size += records.size();
      if (bytes.size() + this->ChunkBytes > TransferBytes)
      {
        write();
      }
    }
    if (size > 0)
    {
      bucket.runs.push_back({ offset, size });
      bucket.chunks = {};
    }
  }
  write();
  this->NextChunk = 0;
}

void OriginalOrder::read(
  std::int64_t first, std::span<std::uint8_t> given, std::span<std::byte> tuples)
{
  assert(first >= 0 && tuples.size() == given.size() * this->TupleBytes);
  std::size_t done = 0;
  while (done < given.size())
  {
    const std::int64_t id = first + static_cast<std::int64_t>(done);
    this->load(id / this->Range);
    const auto place = static_cast<std::size_t>(id % this->Range);
    const std::size_t count =
      std::min(given.size() - done, static_cast<std::size_t>(this->Range) - place);
    const std::size_t held =
      std::min(count, this->Given.size() - std::min(place, this->Given.size()));
    std::fill_n(given.begin() + static_cast<std::ptrdiff_t>(done), count, std::uint8_t(0));
    for (std::size_t i = 0; i < held; ++i)
    {
      if (this->Given[place + i])
      {
        given[done + i] = 1;
        std::memcpy(&tuples[(done + i) * this->TupleBytes],
          &this->Tuples[(place + i) * this->TupleBytes], this->TupleBytes);
      }
    }
    done += count;
  }
}

/** Brings the tuples of a bucket to memory, by their places. */
void OriginalOrder::load(std::int64_t number)
{
  if (number == this->Loaded)
  {
    return;
  }
  this->Loaded = number;
  const std::int64_t end =
    std::clamp<std::int64_t>(this->End - number * this->Range, 0, this->Range);
  this->Given.assign(static_cast<std::size_t>(end), 0);
  this->Tuples.resize(static_cast<std::size_t>(end) * this->TupleBytes);
  const auto bucket = this->Buckets.find(number);
  if (bucket == this->Buckets.end())
  {
    return;
  }
  const std::size_t recordBytes = sizeof(Place) + this->TupleBytes;
  std::vector<std::byte> records;
  for (const Run& run : bucket->second.runs)
  {
    for (std::size_t at = 0; at < run.bytes; at += records.size())
    {
      records.resize(std::min(run.bytes - at, (TransferBytes / recordBytes + 1) * recordBytes));
      this->File.read(run.offset + static_cast<std::int64_t>(at), records);
      this->take(records);
    }
  }
  for (std::size_t i = 0; i < bucket->second.chunks.size(); ++i)
  {
    this->take(this->chunk(bucket->second, i));
  }
}

void OriginalOrder::take(std::span<const std::byte> records)
{
  for (std::size_t at = 0; at < records.size(); at += sizeof(Place) + this->TupleBytes)
  {
    Place place = 0;
    std::memcpy(&place, &records[at], sizeof(place));
    std::memcpy(
      &this->Tuples[place * this->TupleBytes], &records[at + sizeof(place)], this->TupleBytes);
    this->Given[place] = 1;
  }
}

} // namespace smg
