// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/FileDescriptor.h"
#include "Solver/Storage/IoStatistics.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace smg
{

/**
 * A scratch file of blocks of any size that a pass reads from first to last, with the next ones
 * read ahead, and that a pass may rewrite at the same time: what it appends is what the next pass
 * reads. The generation that is being read stays as it is until the pass ends; a block takes the
 * place of the one with its number of the generation before, if it fits there. So pages that the
 * system keeps are overwritten instead of given back and asked for anew.
 *
 * The file has no name: it is gone with the stream or the program. What is read is checked by what
 * was written (XXH3).
 */
class SMG_EXPORT ScratchStream
{
public:
  /** `path` tells the folder, and the name in messages. */
  ScratchStream(std::filesystem::path path, IoStatistics& statistics)
    : Path(std::move(path))
    , Statistics(&statistics)
    , File(FileDescriptor::createNameless(this->Path.parent_path()))
  {
  }

  /** Goes back to the first block; with `rewrite`, append() begins with the first one, too. */
  void startPass(bool rewrite);
  void append(std::span<const std::byte> block);
  /** Bytes of the block that read() delivers next. */
  std::size_t nextBytes() const;
  void read(std::span<std::byte> block);
  /** Block `index` of what the last rewriting pass wrote. */
  std::size_t bytes(std::int64_t index) const;
  void read(std::int64_t index, std::span<std::byte> block);
  void endPass();

private:
  struct Block
  {
    std::int64_t offset = 0;
    std::uint64_t checksum = 0;
    std::size_t bytes = 0;
    std::size_t room = 0; ///< bytes that its place has
  };
  struct Generation
  {
    std::vector<Block> blocks;
    std::int64_t count = 0; ///< of those that it has; the others are places for later ones
  };

  /** Asked of the system at once. */
  static constexpr std::size_t ReadAheadBytes = std::size_t(192) << 10;

  const Block& block(std::int64_t index) const
  {
    return this->Last.blocks.at(static_cast<std::size_t>(index));
  }
  /** The block that is written next, with room for so many bytes. */
  Block& place(std::size_t bytes);
  void readAhead();

  std::filesystem::path Path;
  IoStatistics* Statistics;
  FileDescriptor File;
  Generation Last, Coming; // what the last rewriting pass wrote, and what this one writes
  std::int64_t End = 0;    // of the file
  bool Rewriting = false;
  std::int64_t Next = 0;
  std::int64_t Ahead = 0, Requested = 0; // first block of the last request, and behind it
};

} // namespace smg
