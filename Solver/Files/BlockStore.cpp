// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/BlockStore.h"

#include "Solver/Files/Checksum.h"
#include "Solver/Files/IoStatistics.h"

// Numbered blocks in one scratch file, written and rewritten in any order. Block tables are in
// memory; a block keeps its place unless it grows, and then moves to the end of the file. Every
// read is compared with the checksum of what was written last.

namespace smg
{

void BlockStore::write(std::int64_t index, std::span<const std::byte> bytes)
{
  const WaitClock clock;
  // Blocks between the old end and this one exist from here on, without bytes.
  if (index >= static_cast<std::int64_t>(this->Blocks.size()))
  {
    this->Blocks.resize(static_cast<std::size_t>(index) + 1);
  }
  Block& block = this->Blocks[static_cast<std::size_t>(index)];
  // It moves to the end of the file, and its old room is given up.
  if (bytes.size() > block.room)
  {
    block.offset = this->End;
    block.room = bytes.size();
    this->End += static_cast<std::int64_t>(bytes.size());
  }
  if (const int error = this->File.tryWrite(block.offset, bytes); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
  block.bytes = bytes.size();
  block.checksum = checksum(bytes);
  this->Statistics->bytesWritten += static_cast<std::int64_t>(bytes.size());
  this->Statistics->waitNanoseconds += clock.nanoseconds();
}

std::size_t BlockStore::bytes(std::int64_t index) const
{
  return index < static_cast<std::int64_t>(this->Blocks.size())
           ? this->Blocks[static_cast<std::size_t>(index)].bytes
           : 0;
}

void BlockStore::read(std::int64_t index, std::span<std::byte> bytes)
{
  // A block that was not written reads as one without bytes.
  const Block block =
    this->bytes(index) > 0 ? this->Blocks[static_cast<std::size_t>(index)] : Block{};
  std::int64_t waited = 0;
  if (const int error = this->File.tryRead(block.offset, bytes, waited); error != 0)
  {
    FileDescriptor::throwReadError(this->Path, error);
  }
  if (bytes.size() != block.bytes || (!bytes.empty() && checksum(bytes) != block.checksum))
  {
    throwDamagedBlock(this->Path, index);
  }
  this->Statistics->bytesRead += static_cast<std::int64_t>(bytes.size());
  this->Statistics->waitNanoseconds += waited;
}

void BlockStore::willRead(std::int64_t index) const
{
  if (const std::size_t size = this->bytes(index); size > 0)
  {
    this->File.willRead(this->Blocks[static_cast<std::size_t>(index)].offset, size);
  }
}

} // namespace smg
