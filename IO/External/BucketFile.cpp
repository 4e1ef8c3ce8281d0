// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BucketFile.h"

#include "Solver/Files/State.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace smg
{

namespace
{

constexpr std::int64_t MinMemoryAhead = std::int64_t(4) << 20;

/** Whether the caller can leave work to other threads. */
bool hasHelpers(Workspace& workspace)
{
  return workspace.workers().threads() > 1 && !Workers::isCaller();
}

/** The size of chunks such that those of all buckets, and one that is written, stay below `memory`:
 * whole grains, if they are not smaller. */
std::size_t chunkBytes(Workspace& workspace, int buckets, std::int64_t memory)
{
  const auto chunks = static_cast<std::size_t>(buckets + (hasHelpers(workspace) ? 1 : 0));
  const auto share = static_cast<std::size_t>(memory) / chunks;
  const std::size_t unit =
    share < CheckedFile::GrainBytes ? BucketFile::MinChunkBytes : CheckedFile::GrainBytes;
  return std::clamp(share / unit * unit, BucketFile::MinChunkBytes, BucketFile::ChunkBytes);
}

} // namespace

/** The file, and the chunk that is being written to it. */
class BucketFile::Output
{
public:
  explicit Output(Workspace& workspace)
    : Space(workspace)
    , Job([this] { this->File.append(this->Chunk.bytes()); })
  {
  }
  ~Output()
  {
    if (this->IsWriting)
    {
      this->Space.workers().cancel(this->Job);
    }
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /** Appends the first bytes of a chunk, a full one on another thread if there is one: it is then
   * exchanged. Throws Error. */
  void write(Buffer& chunk, std::size_t bytes)
  {
    this->finish();
    if (!this->File.isOpen())
    {
      this->File.create(this->Space.folder());
    }
    if (bytes < chunk.size() || !hasHelpers(this->Space))
    {
      this->File.append(chunk.bytes().first(bytes));
      return;
    }
    if (!this->Chunk.data())
    {
      this->Chunk = Buffer(this->Space.pool(), chunk.size());
    }
    std::swap(this->Chunk, chunk);
    this->Space.workers().submit(this->Job);
    this->IsWriting = true;
  }
  /** Waits until all is written. Throws Error. */
  void finish()
  {
    if (this->IsWriting)
    {
      this->IsWriting = false;
      this->Space.workers().finish(this->Job);
    }
  }
  void release()
  {
    this->finish();
    this->Chunk = Buffer();
  }

  Workspace& Space;
  CheckedFile File;

private:
  Buffer Chunk;
  Workers::Job Job;
  bool IsWriting = false;
};

BucketFile::BucketFile(Workspace& workspace, int buckets, std::int64_t memory)
  : Space(&workspace)
  , Chunk(chunkBytes(workspace, buckets, memory))
  , Rows(static_cast<std::size_t>(buckets))
  , Out(std::make_unique<Output>(workspace))
{
}

BucketFile::~BucketFile() = default;
BucketFile::BucketFile(BucketFile&&) noexcept = default;
BucketFile& BucketFile::operator=(BucketFile&&) noexcept = default;

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
  const std::int64_t begin = this->End;
  const auto bytes = static_cast<std::int64_t>(row.used);
  this->Out->write(row.chunk, row.used);
  this->End += bytes;
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
  this->Out->release();
}

void BucketFile::save(StateWriter& state, const std::filesystem::path& path)
{
  this->close();
  this->Out->File.save(state, path);
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
  }
}

void BucketFile::load(StateReader& state, const std::filesystem::path& path)
{
  this->Out->File.load(state, path);
  this->End = this->Out->File.size();
  for (Row& row : this->Rows)
  {
    state(row.bytes, row.runs);
    std::int64_t left = row.bytes;
    for (const Run& run : row.runs)
    {
      state.require(run.offset >= 0 && run.offset <= this->End && run.bytes > 0 &&
                    run.bytes <= this->End - run.offset && run.bytes <= left);
      left -= run.bytes;
    }
    state.require(left == 0);
  }
}

std::size_t BucketFile::fill(Position& from, std::span<std::byte> bytes) const
{
  const Row& row = this->Rows[std::size_t(from.bucket)];
  std::size_t filled = 0;
  bool isFull = false; // except for a part of a grain
  while (!isFull && filled < bytes.size() && from.offset < row.bytes)
  {
    const std::size_t room = bytes.size() - filled;
    std::size_t part = 0;
    if (from.run < row.runs.size())
    {
      const Run& run = row.runs[from.run];
      const std::int64_t offset = run.offset + from.runOffset;
      part = std::min(room, static_cast<std::size_t>(run.bytes - from.runOffset));
      isFull = part == room;
      part = isFull ? CheckedFile::untilGrain(offset, room) : part;
      this->Out->File.read(offset, bytes.subspan(filled, part));
      this->Space->traffic().bytesRead += static_cast<std::int64_t>(part);
      from.runOffset += static_cast<std::int64_t>(part);
      if (from.runOffset == run.bytes)
      {
        ++from.run;
        from.runOffset = 0;
      }
    }
    else
    {
      // The last chunk is still in memory.
      const auto done = row.used - static_cast<std::size_t>(row.bytes - from.offset);
      part = std::min(room, row.used - done);
      std::memcpy(bytes.data() + filled, row.chunk.data() + done, part);
    }
    filled += part;
    from.offset += static_cast<std::int64_t>(part);
  }
  return filled;
}

/** The bytes after those of a reader, which another thread fetches. */
class BucketFile::Reader::Ahead
{
public:
  Ahead(const BucketFile& file, const Position& from, std::size_t bytes)
    : File(file)
    , From(from)
    , Bytes(file.Space->pool(), bytes)
    , Job([this] { this->End = this->File.fill(this->From, this->Bytes.bytes()); })
  {
  }
  ~Ahead()
  {
    if (this->IsFetching)
    {
      this->File.Space->workers().cancel(this->Job);
    }
  }
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  /** Takes bytes, as many as there are and have room; 0 at the end. Throws Error. */
  std::size_t take(std::span<std::byte> bytes)
  {
    this->finish();
    const std::size_t part = std::min(bytes.size(), this->End - this->At);
    std::memcpy(bytes.data(), this->Bytes.data() + this->At, part);
    this->At += part;
    if (part > 0 && this->At == this->End)
    {
      this->start();
    }
    return part;
  }
  /** Takes all that was fetched, and says where the rest begins. */
  std::size_t end(std::span<std::byte> bytes, Position& rest)
  {
    this->finish();
    std::memcpy(bytes.data(), this->Bytes.data() + this->At, this->End - this->At);
    rest = this->From;
    return this->End - this->At;
  }
  void start()
  {
    this->At = this->End = 0;
    this->IsFetching = true;
    this->File.Space->workers().submit(this->Job);
  }

private:
  void finish()
  {
    if (this->IsFetching)
    {
      this->IsFetching = false;
      this->File.Space->workers().finish(this->Job);
    }
  }

  const BucketFile& File;
  Position From;
  Buffer Bytes;
  std::size_t At = 0, End = 0;
  Workers::Job Job;
  bool IsFetching = false;
};

BucketFile::Reader::Reader(const BucketFile& file, int bucket, std::size_t bufferBytes)
  : File(&file)
  , From{ bucket }
{
  file.Out->finish();
  Workspace& space = *file.Space;
  std::size_t ahead = 0;
  if (bufferBytes >= MinAheadBytes && file.bytes(bucket) > std::int64_t(bufferBytes) &&
      space.available() > MinMemoryAhead && hasHelpers(space))
  {
    // A part of a record may be left over before the bytes that were fetched.
    ahead = (bufferBytes / 2 - 1) / CheckedFile::GrainBytes * CheckedFile::GrainBytes;
  }
  this->Bytes = Buffer(space.pool(), bufferBytes - ahead);
  this->AheadBytes = ahead;
}

BucketFile::Reader::~Reader() = default;
BucketFile::Reader::Reader(Reader&&) noexcept = default;
BucketFile::Reader& BucketFile::Reader::operator=(Reader&&) noexcept = default;

bool BucketFile::Reader::refill()
{
  const std::size_t kept = this->End - this->At;
  this->File->Space->poll();
  std::memmove(this->Bytes.data(), this->Bytes.data() + this->At, kept);
  const std::span<std::byte> room = this->Bytes.bytes().subspan(kept);
  this->At = 0;
  if (this->Fetched)
  {
    this->End = kept + this->Fetched->take(room);
    return this->End > kept;
  }
  this->End = kept + this->File->fill(this->From, room);
  if (this->AheadBytes > 0)
  {
    this->Fetched = std::make_unique<Ahead>(*this->File, this->From, this->AheadBytes);
    this->Fetched->start();
  }
  return this->End > kept;
}

/** Makes room for longer units than the buffer has when something is fetched ahead. */
void BucketFile::Reader::stopAhead()
{
  Buffer all(this->File->Space->pool(), this->Bytes.size() + this->AheadBytes);
  const std::size_t kept = this->End - this->At;
  std::memcpy(all.data(), this->Bytes.data() + this->At, kept);
  this->At = 0;
  this->End = kept;
  this->Bytes = std::move(all);
  this->AheadBytes = 0;
  if (this->Fetched)
  {
    this->End += this->Fetched->end(this->Bytes.bytes().subspan(kept), this->From);
    this->Fetched.reset();
  }
}

std::span<const std::byte> BucketFile::Reader::next(std::size_t unit, std::size_t most)
{
  if (unit > this->Bytes.size())
  {
    this->stopAhead();
  }
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
