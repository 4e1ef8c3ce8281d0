// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchStream.h"

#include "Solver/Files/Checksum.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Memory/Buffer.h"

#include <string>
#include <utility>

namespace smg
{

void ScratchStream::startPass(bool rewrite)
{
  this->Rewriting = rewrite;
  this->Coming.count = 0;
  this->Next = this->Ahead = this->Requested = 0;
  this->readAhead();
}

/** Requests the next range of blocks when the blocks of the last request are being read. */
void ScratchStream::readAhead()
{
  if (this->Next < this->Ahead || this->Requested >= this->Last.count)
  {
    return;
  }
  this->Ahead = this->Requested;
  std::int64_t begin = 0;
  std::size_t bytes = 0;
  // As long as the blocks are contiguous; some have no bytes.
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
  const WaitClock clock;
  Block& block = this->place(bytes.size());
  if (const int error = this->File.tryWrite(block.offset, bytes); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
  block.bytes = bytes.size();
  block.checksum = checksum(bytes);
  ++this->Coming.count;
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
  this->readAhead();
  ++this->Next;
}

void ScratchStream::endPass()
{
  if (this->Rewriting)
  {
    this->Rewriting = false;
    std::swap(this->Last, this->Coming);
  }
}

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

/** Requires that the places are in the file. */
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
