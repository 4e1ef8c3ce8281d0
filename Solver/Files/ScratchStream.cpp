// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchStream.h"

#include "Solver/Files/Checksum.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Memory/Buffer.h"

#include <string>
#include <utility>

// A scratch file of blocks in two generations. A pass reads one generation from first to last while
// it writes the next one; endPass() exchanges their roles.
//
// Invariant: a pass never writes to a place of the generation that it reads. A block takes the
// place of the block with its index two passes ago, or one at the end of the file if it does not
// fit there. So everything that save() has recorded stays as it is during the whole next pass, and
// a program killed in that pass continues from it.
//
// Cost: the file has room for two generations; in memory, each block costs its entry in two tables.
// Every block is read and written once in a pass, and its checksum computed each time.

namespace smg
{

void ScratchStream::startPass(bool rewrite)
{
  this->Rewriting = rewrite;
  this->Coming.count = 0;
  this->Next = this->Ahead = this->Requested = 0;
  this->readAhead();
}

/** Asks the system for the next range of blocks as soon as reading arrives at the range asked for
 * before: so one range is being used while the following one comes from the disk. */
void ScratchStream::readAhead()
{
  if (this->Next < this->Ahead || this->Requested >= this->Last.count)
  {
    return;
  }
  // What was asked for before has been reached: the new range begins behind it.
  this->Ahead = this->Requested;
  std::int64_t begin = 0;
  std::size_t bytes = 0;
  // One request covers blocks that follow each other in the file. A block that was moved to the end
  // of the file ends the range; blocks without bytes do not.
  for (; this->Requested < this->Last.count; ++this->Requested)
  {
    const Block& block = this->block(this->Requested);
    const bool adjoins = block.offset == begin + static_cast<std::int64_t>(bytes);
    if (bytes > 0 && (!adjoins || bytes + block.room > ReadAheadBytes))
    {
      break;
    }
    begin = bytes == 0 ? block.offset : begin;
    bytes += block.room;
  }
  if (bytes > 0)
  {
    this->File.willRead(begin, bytes);
  }
}

/**
 * The place of the next block: where the block with its index was in the generation before the one
 * being read. Pages in the cache of the system are thus overwritten, not released and allocated
 * again. A block that has become larger moves to the end; the room that it leaves is not used
 * again, which costs little, since the sizes of blocks hardly change from pass to pass.
 */
auto ScratchStream::place(std::size_t bytes) -> Block&
{
  const auto index = static_cast<std::size_t>(this->Coming.count);
  if (index == this->Coming.blocks.size())
  {
    this->Coming.blocks.push_back({ .offset = this->End });
  }
  Block& block = this->Coming.blocks[index];
  if (bytes > block.room)
  {
    block.offset = this->End;
    block.room = bytes;
    this->End += static_cast<std::int64_t>(bytes);
  }
  return block;
}

void ScratchStream::append(std::span<const std::byte> bytes)
{
  // Writing to the cache costs processor time; WaitClock counts only the rest, in which the disk is
  // slow.
  const WaitClock clock;
  Block& block = this->place(bytes.size());
  if (const int error = this->File.tryWrite(block.offset, bytes); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
  block.bytes = bytes.size();
  block.checksum = checksum(bytes);
  ++this->Coming.count;
  // save() waits for the disk only if there is something to wait for.
  this->Unsynced = true;
  this->Statistics->bytesWritten += static_cast<std::int64_t>(bytes.size());
  this->Statistics->waitNanoseconds += clock.nanoseconds();
}

std::size_t ScratchStream::bytes(std::int64_t index) const
{
  return this->block(index).bytes;
}

std::size_t ScratchStream::nextBytes() const
{
  return this->bytes(this->Next);
}

void ScratchStream::read(std::int64_t index, std::span<std::byte> bytes)
{
  const Block& block = this->block(index);
  std::int64_t waited = 0;
  if (const int error = this->File.tryRead(block.offset, bytes, waited); error != 0)
  {
    FileDescriptor::throwReadError(this->Path, error);
  }
  // The checksum was computed from the bytes in memory when they were written, so it finds whatever
  // the disk, its cable or the file system has done to them.
  if (bytes.size() != block.bytes || checksum(bytes) != block.checksum)
  {
    throwDamagedBlock(this->Path, index);
  }
  this->Statistics->bytesRead += static_cast<std::int64_t>(bytes.size());
  this->Statistics->waitNanoseconds += waited;
}

void ScratchStream::read(std::span<std::byte> block)
{
  this->read(this->Next, block);
  // Before Next advances: reading the first block of the last range asks for the range behind it.
  this->readAhead();
  ++this->Next;
}

void ScratchStream::endPass()
{
  // A pass that only read leaves the generation to be read again.
  if (this->Rewriting)
  {
    this->Rewriting = false;
    std::swap(this->Last, this->Coming);
  }
}

/** The blocks are made durable before the caller writes the state that refers to them. Both tables
 * are saved: the continued program writes to the same places as the one that was killed. */
void ScratchStream::save(StateWriter& state)
{
  if (std::exchange(this->Unsynced, false))
  {
    const WaitClock clock;
    this->File.sync();
    this->Statistics->waitNanoseconds += clock.nanoseconds();
  }
  state.part(this->Path.filename().string());
  state(this->End, this->Last, this->Coming);
}

void ScratchStream::load(StateReader& state, std::int64_t blocks, const BlockCheck& check)
{
  state.part(this->Path.filename().string());
  state(this->End, this->Last, this->Coming);
  state.require(this->End >= 0 && this->Last.count == blocks);
  this->checkPlaces(this->Last, state);
  this->checkPlaces(this->Coming, state);
  // Only the generation that will be read is compared; the other one is going to be overwritten.
  Buffer bytes;
  for (std::int64_t i = 0; i < this->Last.count; ++i)
  {
    const Block& block = this->block(i);
    if (bytes.capacity() < block.bytes)
    {
      bytes = Buffer(state.pool(), block.bytes);
    }
    bytes.resize(block.bytes);
    if (this->File.tryRead(block.offset, bytes.bytes()) != 0 ||
        checksum(bytes.bytes()) != block.checksum)
    {
      state.fail("since block " + std::to_string(i) + " of " + this->Path.string() + " is");
    }
    if (check)
    {
      check(i, bytes.bytes());
    }
  }
}

/** Requires that all places lie within the file, as far as the state says where that ends: a
 * damaged state must not make later writes or reads go elsewhere. The comparison avoids sums that
 * overflow. */
void ScratchStream::checkPlaces(const Generation& generation, const StateReader& state) const
{
  const auto end = static_cast<std::uint64_t>(this->End);
  state.require(generation.count >= 0 &&
                static_cast<std::size_t>(generation.count) <= generation.blocks.size());
  for (const Block& block : generation.blocks)
  {
    state.require(block.offset >= 0 && block.bytes <= block.room && block.room <= end &&
                  static_cast<std::uint64_t>(block.offset) <= end - block.room);
  }
}

} // namespace smg
