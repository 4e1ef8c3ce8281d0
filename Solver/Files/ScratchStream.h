// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/BlockStore.h"
#include "smg/Export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace smg
{

/**
 * A scratch file of blocks of any size. A pass reads them from first to last, with read-ahead, and
 * may at the same time append the blocks that the next pass reads. The generation that is read is
 * not modified until the pass ends.
 *
 * In a kept folder, after save() another program can read the generation of the last rewriting
 * pass, as long as no second rewriting pass has begun.
 */
class SMG_EXPORT ScratchStream
{
public:
  /** An unnamed file in the folder of `path`, which is its name in messages. */
  ScratchStream(std::filesystem::path path, IoStatistics& statistics)
    : Blocks(std::move(path), statistics)
  {
  }
  /** A file of `folder`. */
  ScratchStream(const ScratchFolder& folder, const std::string& name, IoStatistics& statistics)
    : Blocks(folder, name, statistics)
  {
  }

  /** Restarts reading at the first block; with `rewrite`, also appending. */
  void startPass(bool rewrite);
  void append(std::span<const std::byte> block);
  /** Bytes of the next block to read. */
  std::size_t nextBytes() const { return this->bytes(this->Next); }
  void read(std::span<std::byte> block);
  /** Bytes of block `index` of the last rewriting pass. */
  std::size_t bytes(std::int64_t index) const { return this->Blocks.bytes(index, this->Last); }
  void read(std::int64_t index, std::span<std::byte> block);
  void endPass();

  /** Between passes: waits until the disk has the blocks, and saves their places. */
  void save(StateWriter& state);
  /** Receives the number of a block and its bytes. */
  using BlockCheck = std::function<void(std::int64_t, std::span<const std::byte>)>;
  /** Restores the places, and compares all blocks of the last rewriting pass with their checksums.
   * There must be `blocks` of them. `check` is called with each. */
  void load(StateReader& state, std::int64_t blocks, const BlockCheck& check = {});

private:
  void readAhead();
  std::int64_t& count(int generation) { return this->Counts[static_cast<std::size_t>(generation)]; }

  BlockStore Blocks;
  std::array<std::int64_t, 2> Counts{}; // of the blocks in use of each generation
  int Last = 0; // the generation of the last rewriting pass; the other one is the current one's
  bool Rewriting = false;
  std::int64_t Next = 0;
  std::int64_t Ahead = 0, Requested = 0; // first block of the last request, and its end
};

} // namespace smg
