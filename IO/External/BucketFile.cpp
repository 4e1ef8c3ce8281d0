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

constexpr std::size_t BufferAlignment = 64;

/** The size of chunks such that those of all buckets stay below `memory`. */
std::size_t chunkBytes(int buckets, std::int64_t memory)
{
  const auto share = static_cast<std::size_t>(memory) / static_cast<std::size_t>(buckets);
  return std::clamp(
    share / BufferAlignment * BufferAlignment, BucketFile::LeastChunkBytes, BucketFile::ChunkBytes);
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
    this->File = FileDescriptor::createNameless(this->Space->folder());
  }
  const auto bytes = static_cast<std::int64_t>(row.used);
  this->File.write(this->FileEnd, row.chunk.bytes().first(row.used));
  this->Space->traffic().bytesWritten += bytes;
  if (!row.runs.empty() && row.runs.back().offset + row.runs.back().bytes == this->FileEnd)
  {
    row.runs.back().bytes += bytes;
  }
  else
  {
    row.runs.push_back({ this->FileEnd, bytes });
  }
  this->FileEnd += bytes;
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
  if (!this->IsNamed && this->File.isOpen())
  {
    this->File.giveName(path);
    this->File.sync();
    this->Checksum = this->contentChecksum();
  }
  this->IsNamed = true;
  state.part(path.filename().string());
  state(this->FileEnd, this->Checksum);
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
  }
}

void BucketFile::load(StateReader& state, const std::filesystem::path& path)
{
  state.part(path.filename().string());
  state(this->FileEnd, this->Checksum);
  state.require(this->FileEnd >= 0);
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
    std::int64_t left = row.bytes;
    for (const Run& run : row.runs)
    {
      state.require(run.offset >= 0 && run.offset <= this->FileEnd && run.bytes > 0 &&
                    run.bytes <= this->FileEnd - run.offset && run.bytes <= left);
      left -= run.bytes;
    }
    state.require(left == 0);
  }
  this->IsNamed = true;
  if (this->FileEnd > 0)
  {
    this->File = FileDescriptor::openForReading(path);
    if (this->File.size() < this->FileEnd || this->contentChecksum() != this->Checksum)
    {
      state.fail("since " + path.string() + " is");
    }
  }
}

std::uint64_t BucketFile::contentChecksum() const
{
  Buffer part(this->Space->pool(), LeastChunkBytes);
  std::uint64_t sum = 0;
  for (std::int64_t at = 0; at < this->FileEnd; at += static_cast<std::int64_t>(part.size()))
  {
    part.resize(
      static_cast<std::size_t>(std::min<std::int64_t>(this->FileEnd - at, LeastChunkBytes)));
    this->File.read(at, part.bytes());
    sum = StatePages::add(sum, part.bytes());
  }
  return sum;
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
  while (this->End < this->Bytes.size() && this->Offset < row.bytes)
  {
    const std::size_t room = this->Bytes.size() - this->End;
    std::size_t part = 0;
    if (this->NextRun < row.runs.size())
    {
      const Run& run = row.runs[this->NextRun];
      part = std::min(room, static_cast<std::size_t>(run.bytes - this->RunOffset));
      this->File->File.read(
        run.offset + this->RunOffset, this->Bytes.bytes().subspan(this->End, part));
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
  if (this->End - this->At < unit)
  {
    this->refill();
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
