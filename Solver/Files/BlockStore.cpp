// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/BlockStore.h"

#include "Solver/Files/Checksum.h"

#include <string>
#include <utility>

// Numbered blocks in one scratch file, written and rewritten in any order. The tables of their
// places are in memory. A block keeps its place unless it grows: pages in the cache of the system
// are thus overwritten, not released and allocated again. One that grows moves to the end, and the
// room that it leaves is not used again, which costs little, since the sizes of blocks hardly
// change. Every read is compared with the checksum of what was written last, computed from the
// bytes in memory: so it finds whatever the disk, its cable or the file system has done to them.

namespace smg
{

void BlockStore::write(std::int64_t index, std::span<const std::byte> bytes, int generation)
{
  // Writing to the cache costs processor time; WaitClock counts only the rest, in which the disk is
  // slow.
  const WaitClock clock;
  std::vector<Block>& blocks = this->Blocks[static_cast<std::size_t>(generation)];
  // Blocks between the old end and this one exist from here on, without bytes.
  if (index >= std::ssize(blocks))
  {
    blocks.resize(static_cast<std::size_t>(index) + 1);
  }
  Block& block = blocks[static_cast<std::size_t>(index)];
  if (bytes.size() > block.room)
  {
    block.offset = this->End;
    block.room = bytes.size();
    this->End += std::ssize(bytes);
  }
  if (const int error = this->File.tryWrite(block.offset, bytes); error != 0)
  {
    FileDescriptor::throwWriteError(this->Path, error);
  }
  block.bytes = bytes.size();
  block.checksum = checksum(bytes);
  // save() waits for the disk only if there is something to wait for.
  this->Unsynced = true;
  this->Statistics->bytesWritten += std::ssize(bytes);
  this->Statistics->waitNanoseconds += clock.nanoseconds();
}

auto BlockStore::at(std::int64_t index, int generation) const -> Block
{
  const std::vector<Block>& blocks = this->Blocks[static_cast<std::size_t>(generation)];
  return index < std::ssize(blocks) ? blocks[static_cast<std::size_t>(index)] : Block{};
}

std::size_t BlockStore::bytes(std::int64_t index, int generation) const
{
  return this->at(index, generation).bytes;
}

void BlockStore::read(std::int64_t index, std::span<std::byte> bytes, int generation)
{
  const Block block = this->at(index, generation);
  std::int64_t waited = 0;
  if (const int error = this->File.tryRead(block.offset, bytes, waited); error != 0)
  {
    FileDescriptor::throwReadError(this->Path, error);
  }
  if (bytes.size() != block.bytes || (!bytes.empty() && checksum(bytes) != block.checksum))
  {
    throwDamagedBlock(this->Path, index);
  }
  this->Statistics->bytesRead += std::ssize(bytes);
  this->Statistics->waitNanoseconds += waited;
}

std::int64_t BlockStore::willRead(std::int64_t begin, std::int64_t end, int generation) const
{
  constexpr std::size_t MostBytes = std::size_t(192) << 10;
  std::int64_t offset = 0;
  std::size_t bytes = 0;
  // One request for all. A block that was moved to the end of the file ends it; blocks without
  // bytes do not.
  for (; begin < end; ++begin)
  {
    const Block block = this->at(begin, generation);
    if (block.room == 0)
    {
      continue;
    }
    const bool adjoins = block.offset == offset + static_cast<std::int64_t>(bytes);
    if (bytes > 0 && (!adjoins || bytes + block.room > MostBytes))
    {
      break;
    }
    offset = bytes == 0 ? block.offset : offset;
    bytes += block.room;
  }
  if (bytes > 0)
  {
    this->File.willRead(offset, bytes);
  }
  return begin;
}

/** The blocks are made durable before the caller writes the state that refers to them. All places
 * are saved: the continued program writes to the same ones as the program that was killed. */
void BlockStore::save(StateWriter& state)
{
  if (std::exchange(this->Unsynced, false))
  {
    const WaitClock clock;
    this->File.sync();
    this->Statistics->waitNanoseconds += clock.nanoseconds();
  }
  state.part(this->Path.filename().string());
  state(this->End, this->Blocks[0], this->Blocks[1]);
}

/** Requires that all places lie within the file, as far as the state says where that ends: a
 * damaged state must not make later writes or reads go elsewhere. The comparison avoids sums that
 * overflow. */
void BlockStore::load(StateReader& state)
{
  state.part(this->Path.filename().string());
  state(this->End, this->Blocks[0], this->Blocks[1]);
  state.require(this->End >= 0);
  const auto end = static_cast<std::uint64_t>(this->End);
  for (const std::vector<Block>& blocks : this->Blocks)
  {
    for (const Block& block : blocks)
    {
      state.require(block.offset >= 0 && block.bytes <= block.room && block.room <= end &&
                    static_cast<std::uint64_t>(block.offset) <= end - block.room);
    }
  }
}

void BlockStore::check(
  StateReader& state, std::int64_t index, std::span<std::byte> bytes, int generation) const
{
  const Block block = this->at(index, generation);
  if (this->File.tryRead(block.offset, bytes) != 0 || checksum(bytes) != block.checksum)
  {
    state.fail("since block " + std::to_string(index) + " of " + this->Path.string() + " is");
  }
}

} // namespace smg
