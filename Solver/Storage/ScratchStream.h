// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Storage/BlockFile.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace smg
{

/**
 * A scratch file of blocks of any size that a pass reads from first to last, with the next ones
 * read ahead, and that a pass may rewrite at the same time: what it appends is what the next pass
 * reads.
 */
class ScratchStream
{
public:
  ScratchStream(std::filesystem::path path, IoStatistics& statistics)
    : Path(std::move(path))
    , Statistics(&statistics)
  {
  }
  ~ScratchStream();

  /** Goes back to the first block; with `rewrite`, append() begins the next generation. */
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
  /** Asked of the system at once. */
  static constexpr std::size_t ReadAheadBytes = std::size_t(192) << 10;

  void readAhead();
  std::filesystem::path generationPath(int generation) const;

  std::filesystem::path Path;
  IoStatistics* Statistics;
  std::unique_ptr<BlockFileReader> Reader;
  std::unique_ptr<BlockFileWriter> Writer;
  int Generation = 0;
  std::int64_t Next = 0;
  std::int64_t Ahead = 0, Requested = 0; // first block of the last request, and behind it
};

} // namespace smg
