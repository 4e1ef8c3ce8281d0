// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/ScratchStream.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace smg
{

/**
 * What a job keeps of the vertices besides their rows: a record for each block of rows
 * (RowBlock::Nodes vertices), written in the first pass to a scratch file or memory. A later pass
 * takes the records in this order, as its windows advance.
 */
class SMG_EXPORT VertexRecords
{
public:
  /** The bytes of a record: its own, or those that stay in memory. */
  class Record
  {
  public:
    explicit Record(Buffer buffer)
      : Owned(std::move(buffer))
      , Data(this->Owned.data())
      , Size(this->Owned.size())
    {
    }
    explicit Record(std::span<std::byte> bytes)
      : Data(bytes.data())
      , Size(bytes.size())
    {
    }

    std::byte* data() const { return this->Data; }
    std::size_t size() const { return this->Size; }

  private:
    Buffer Owned;
    std::byte* Data;
    std::size_t Size;
  };

  /** `name`: of the scratch file. */
  VertexRecords(Pool& pool, std::string name)
    : Memory(&pool)
    , Name(std::move(name))
  {
  }

  /** Keeps the records in a scratch file in `folder`; otherwise they stay in memory. */
  void useScratch(const ScratchFolder& folder, ScratchTraffic& traffic);

  // During the first pass:

  Pool& pool() const { return *this->Memory; }
  void append(Buffer record);
  void finish();

  // Afterwards:

  /** Restarts next() at the first record. */
  void startPass();
  /** The next record of a pass; one that stays in memory may be modified there. */
  Record next();
  void endPass();
  /** The record of a block, in any order. */
  Record at(std::int64_t block);
  /** Saves the records, which are in a scratch file. */
  void save(StateWriter& state);
  /** Restores them; `check` is called with each. */
  void load(StateReader& state, std::int64_t blocks, const ScratchStream::BlockCheck& check);

private:
  Pool* Memory;
  std::string Name;
  std::optional<ScratchStream> Scratch;
  std::deque<Buffer> Resident; ///< the records, without a scratch file
  std::size_t Next = 0;
};

} // namespace smg
