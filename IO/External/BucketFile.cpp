// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BucketFile.h"

#include "Solver/Storage/StateWriter.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace smg
{

namespace
{

/** The size of chunks such that those of all buckets stay below `memory`: whole grains, if they are
 * not smaller. */
std::size_t chunkBytes(int buckets, std::int64_t memory)
{
  const auto share = static_cast<std::size_t>(memory) / static_cast<std::size_t>(buckets);
  const std::size_t unit =
    share < CheckedFile::GrainBytes ? BucketFile::LeastChunkBytes : CheckedFile::GrainBytes;
  return std::clamp(share / unit * unit, BucketFile::LeastChunkBytes, BucketFile::ChunkBytes);
}

} // namespace

BucketFile::BucketFile(Workspace& workspace, int buckets, std::int64_t memory)
  : Space(&workspace)
  , Chunk(chunkBytes(buckets, memory))
  , Rows(static_cast<std::size_t>(buckets))
{
}

void BucketFile::appendSlowly(Row& row, std::span<const std::byte> bytes)
{
  if (!row.chunk.data())
  {
    row.chunk = Buffer(this->Space->pool(), this->Chunk);
  }
  while (!bytes.empty())
  {
    const std::size_t part = std::min(bytes.size(), this->Chunk - row.used);
    std::memcpy(row.chunk.data() + row.used, bytes.data(), part);
    row.used += part;
    row.bytes += static_cast<std::int64_t>(part);
    bytes = bytes.subspan(part);
    if (row.used == this->Chunk)
    {
      this->flush(row);
    }
  }
}

void BucketFile::flush(Row& row)
{
  if (row.used == 0)
  {
    return;
  }
  if (!this->File.isOpen())
  {
    this->File.create(this->Space->folder());
  }
  const std::int64_t begin = this->File.size();
  const auto bytes = static_cast<std::int64_t>(row.used);
  this->File.append(row.chunk.bytes().first(row.used));
  this->Space->traffic().bytesWritten += bytes;
  if (!row.runs.empty() && row.runs.back().offset + row.runs.back().bytes == begin)
  {
    row.runs.back().bytes += bytes;
  }
  else
  {
    row.runs.push_back({ begin, bytes });
  }
  row.used = 0;
  this->Space->poll();
}

void BucketFile::close()
{
  for (Row& row : this->Rows)
  {
    this->flush(row);
    row.chunk = Buffer();
  }
}

void BucketFile::save(StateWriter& state, const std::filesystem::path& path)
{
  this->close();
  this->File.save(state, path);
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
  }
}

void BucketFile::load(StateReader& state, const std::filesystem::path& path)
{
  this->File.load(state, path);
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
    std::int64_t left = row.bytes;
    for (const Run& run : row.runs)
    {
      state.require(run.offset >= 0 && run.offset <= this->File.size() && run.bytes > 0 &&
                    run.bytes <= this->File.size() - run.offset && run.bytes <= left);
      left -= run.bytes;
    }
    state.require(left == 0);
  }
}

BucketFile::Reader::Reader(const BucketFile& file, int bucket, std::size_t bufferBytes)
  : File(&file)
  , Bucket(bucket)
  , Bytes(file.Space->pool(), bufferBytes)
{
}

bool BucketFile::Reader::refill()
{
  const Row& row = this->File->Rows[std::size_t(this->Bucket)];
  const std::size_t kept = this->End - this->At;
  this->File->Space->poll();
  std::memmove(this->Bytes.data(), this->Bytes.data() + this->At, kept);
  this->At = 0;
  this->End = kept;
  bool isFull = false; // except for a part of a grain
  while (!isFull && this->End < this->Bytes.size() && this->Offset < row.bytes)
  {
    const std::size_t room = this->Bytes.size() - this->End;
    std::size_t part = 0;
    if (this->NextRun < row.runs.size())
    {
      const Run& run = row.runs[this->NextRun];
      const std::int64_t offset = run.offset + this->RunOffset;
      part = std::min(room, static_cast<std::size_t>(run.bytes - this->RunOffset));
      isFull = part == room;
      part = isFull ? CheckedFile::untilGrain(offset, room) : part;
      this->File->File.read(offset, this->Bytes.bytes().subspan(this->End, part));
      this->File->Space->traffic().bytesRead += static_cast<std::int64_t>(part);
      this->RunOffset += static_cast<std::int64_t>(part);
      if (this->RunOffset == run.bytes)
      {
        ++this->NextRun;
        this->RunOffset = 0;
      }
    }
    else
    {
      // The last chunk is still in memory.
      const auto done = row.used - static_cast<std::size_t>(row.bytes - this->Offset);
      part = std::min(room, row.used - done);
      std::memcpy(this->Bytes.data() + this->End, row.chunk.data() + done, part);
    }
    this->End += part;
    this->Offset += static_cast<std::int64_t>(part);
  }
  return this->End > kept;
}

std::span<const std::byte> BucketFile::Reader::next(std::size_t unit, std::size_t most)
{
  assert(unit <= this->Bytes.size());
  while (this->End - this->At < unit && this->refill())
  {
  }
  const std::size_t bytes = std::min(this->End - this->At, most) / unit * unit;
  const std::size_t at = this->At;
  this->At += bytes;
  return this->Bytes.bytes().subspan(at, bytes);
}

bool BucketFile::Reader::read(std::span<std::byte> bytes)
{
  std::size_t done = 0;
  while (done < bytes.size())
  {
    if (this->At == this->End && !this->refill())
    {
      return false;
    }
    const std::size_t part = std::min(bytes.size() - done, this->End - this->At);
    std::memcpy(bytes.data() + done, this->Bytes.data() + this->At, part);
    this->At += part;
    done += part;
  }
  return true;
}

} // namespace smg
