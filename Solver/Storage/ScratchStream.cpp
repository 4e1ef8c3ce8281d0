// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/ScratchStream.h"

#include "Solver/Storage/Checksum.h"
#include "Solver/Storage/WaitClock.h"
#include "smg/Error.h"

#include <string>

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
    throw Error(this->Path.string() + ": block " + std::to_string(index) +
                " differs from what was written: check the disk for faults, or use another one.");
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

} // namespace smg
