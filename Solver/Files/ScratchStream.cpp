// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/ScratchStream.h"

#include "Solver/Memory/Buffer.h"

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
  this->count(1 - this->Last) = 0;
  this->Next = this->Ahead = this->Requested = 0;
  this->readAhead();
}

/** Asks the system for the next range of blocks as soon as reading arrives at the range asked for
 * before: so one range is being used while the following one comes from the disk. */
void ScratchStream::readAhead()
{
  const std::int64_t blocks = this->count(this->Last);
  if (this->Next < this->Ahead || this->Requested >= blocks)
  {
    return;
  }
  // What was asked for before has been reached: the new range begins behind it.
  this->Ahead = this->Requested;
  this->Requested = this->Blocks.willRead(this->Requested, blocks, this->Last);
}

void ScratchStream::append(std::span<const std::byte> bytes)
{
  const int coming = 1 - this->Last;
  this->Blocks.write(this->count(coming), bytes, coming);
  ++this->count(coming);
}

void ScratchStream::read(std::int64_t index, std::span<std::byte> bytes)
{
  this->Blocks.read(index, bytes, this->Last);
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
  if (std::exchange(this->Rewriting, false))
  {
    this->Last = 1 - this->Last;
  }
}

/** Both generations are saved: the continued program writes to the same places as the one that was
 * killed. */
void ScratchStream::save(StateWriter& state)
{
  this->Blocks.save(state);
  state(this->Last, this->Counts);
}

void ScratchStream::load(StateReader& state, std::int64_t blocks, const BlockCheck& check)
{
  this->Blocks.load(state);
  state(this->Last, this->Counts);
  state.require((this->Last == 0 || this->Last == 1) && this->count(this->Last) == blocks);
  // Only the generation that will be read is compared; the other one is going to be overwritten.
  Buffer bytes;
  for (std::int64_t i = 0; i < blocks; ++i)
  {
    const std::size_t size = this->bytes(i);
    if (bytes.capacity() < size)
    {
      bytes = Buffer(state.pool(), size);
    }
    bytes.resize(size);
    this->Blocks.check(state, i, bytes.bytes(), this->Last);
    if (check)
    {
      check(i, bytes.bytes());
    }
  }
}

} // namespace smg
