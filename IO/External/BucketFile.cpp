// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BucketFile.h"

#include "Solver/Files/State.h"

#include <algorithm>
#include <cassert>

// Sequences of bytes in one scratch file, appended to in any order, each read from first to last. A
// bucket collects its bytes in a chunk and writes that when it is full, so the file is written from
// first to last and a bucket is a list of runs in it. With n buckets and m bytes of memory a run
// has about m / n bytes: this decides how scattered the reads are.
//
// With several threads a full chunk is written by another one while the next is filled, and a
// reader's next bytes are fetched while it uses those before. What a bucket holds does not depend
// on that. CheckedFile adds checksums; reads end with its grains where possible, so that no grain
// is read twice.

namespace smg
{

namespace
{

constexpr std::int64_t MinMemoryAhead = std::int64_t(4) << 20;

/** Whether the caller can leave work to other threads: not in a job, which must not wait for other
 * jobs. */
bool hasHelpers(Workspace& workspace)
{
  return workspace.workers().threads() > 1 && !Workers::isCaller();
}

/** The size of a chunk, such that one for each bucket, and one that is being written, stay below
 * `memory`: whole grains, unless they are smaller than one. */
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
    , Writing(workspace.workers(), [this] { this->File.append(this->Chunk.bytes()); })
  {
  }

  /** Appends the first bytes of a chunk, a full one on another thread if there is one: it is then
   * exchanged. Throws Error. */
  void write(Buffer& chunk, std::size_t bytes)
  {
    // One chunk at a time: the file grows in the order of the calls.
    this->Writing.finish();
    if (!this->File.isOpen())
    {
      this->File.create(this->Space.folder());
    }
    // The last, partly filled chunk of a bucket is written at once: it is released next.
    if (bytes < chunk.size() || !hasHelpers(this->Space))
    {
      this->File.append(chunk.bytes().first(bytes));
      return;
    }
    if (!this->Chunk.data())
    {
      this->Chunk = Buffer(this->Space.pool(), chunk.size());
    }
    // The bucket goes on with the memory of the chunk that was written before.
    std::swap(this->Chunk, chunk);
    this->Writing.submit();
  }
  /** Waits until all is written. Throws Error. */
  void finish() { this->Writing.finish(); }
  void release()
  {
    this->finish();
    this->Chunk = Buffer();
  }

  Workspace& Space;
  CheckedFile File;

private:
  Buffer Chunk;
  Workers::Job Writing;
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

/** append() for a bucket without a chunk, or whose chunk is about to become full. */
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
  // The only bucket of a file has a single run, whatever its length.
  if (!row.runs.empty() && row.runs.back().offset + row.runs.back().bytes == begin)
  {
    row.runs.back().bytes += bytes;
  }
  else
  {
    row.runs.push_back({ begin, bytes });
  }
  row.used = 0;
  // After each chunk: the progress counts traffic.
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
      // Runs lie within the file, and have all bytes of the bucket: reads need no further checks.
      state.require(run.offset >= 0 && run.offset <= this->End && run.bytes > 0 &&
                    run.bytes <= this->End - run.offset && run.bytes <= left);
      left -= run.bytes;
    }
    state.require(left == 0);
  }
}

/** Runs first, then the chunk that is still in memory. It changes only `from`, so readers on
 * several threads may be in it at the same time. */
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
      // A run that fills the room may be cut short so that the next read begins with a grain.
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

/** What comes after the bytes of a reader; another thread fetches it. */
class BucketFile::Reader::Ahead
{
public:
  Ahead(const BucketFile& file, const Position& from, std::size_t bytes)
    : File(file)
    , From(from)
    , Bytes(file.Space->pool(), bytes)
    , Fetching(file.Space->workers(),
        [this] { this->End = this->File.fill(this->From, this->Bytes.bytes()); })
  {
  }

  /** Takes bytes, as many as there are and have room; 0 at the end. Throws Error. */
  std::size_t take(std::span<std::byte> bytes)
  {
    this->Fetching.finish();
    const std::size_t part = std::min(bytes.size(), this->End - this->At);
    std::memcpy(bytes.data(), this->Bytes.data() + this->At, part);
    this->At += part;
    // All was taken: the next bytes are fetched while the reader uses these.
    if (part > 0 && this->At == this->End)
    {
      this->start();
    }
    return part;
  }
  /** Takes all that was fetched, and sets `rest` to where the bytes after it begin. */
  std::size_t end(std::span<std::byte> bytes, Position& rest)
  {
    this->Fetching.finish();
    std::memcpy(bytes.data(), this->Bytes.data() + this->At, this->End - this->At);
    rest = this->From;
    return this->End - this->At;
  }
  void start()
  {
    this->At = this->End = 0;
    this->Fetching.submit();
  }

private:
  const BucketFile& File;
  Position From;
  Buffer Bytes;
  std::size_t At = 0, End = 0;
  Workers::Job Fetching;
};

BucketFile::Reader::Reader(const BucketFile& file, int bucket, std::size_t bufferBytes)
  : File(&file)
  , From{ bucket }
{
  // The last chunk may still be on its way to the file.
  file.Out->finish();
  Workspace& space = *file.Space;
  std::size_t ahead = 0;
  // Only where it pays: a large buffer, more bytes than it holds, and memory to spare.
  if (bufferBytes >= MinAheadBytes && file.bytes(bucket) > std::int64_t(bufferBytes) &&
      space.available() > MinMemoryAhead && hasHelpers(space))
  {
    // Less than half of the buffer, as part of a record may be left over in front of the bytes that
    // were fetched.
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
  // What was not used yet moves to the front.
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

/** Gives up fetching ahead, so that the whole memory of the reader is one buffer: for units that
 * are longer than the buffer beside it. */
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
