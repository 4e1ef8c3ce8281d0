// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/IoStatistics.h"
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
 * A scratch file of numbered blocks that are written, rewritten and read in any order. A block
 * keeps its place unless it grows. Blocks that were not written have no bytes.
 *
 * The file is unnamed: it disappears with this object or the program. Checksums (XXH3) verify that
 * the bytes read are those written.
 */
class SMG_EXPORT BlockStore
{
public:
  /** Memory for each block, with room for more. */
  static constexpr std::int64_t TableBytes = 64;

  /** An unnamed file in the folder of `path`, which is its name in messages. */
  BlockStore(std::filesystem::path path, IoStatistics& statistics)
    : Path(std::move(path))
    , Statistics(&statistics)
    , File(FileDescriptor::createNameless(this->Path.parent_path()))
  {
  }

  void write(std::int64_t index, std::span<const std::byte> bytes);
  /** Bytes of a block; 0 if it was not written. */
  std::size_t bytes(std::int64_t index) const;
  /** Reads a block of exactly this size. */
  void read(std::int64_t index, std::span<std::byte> bytes);
  /** Announces a read of the block, so that the system starts to load it from disk. */
  void willRead(std::int64_t index) const;

private:
  struct Block
  {
    std::int64_t offset = 0;
    std::uint64_t checksum = 0;
    std::size_t bytes = 0;
    std::size_t room = 0; ///< capacity in bytes
  };

  static_assert(2 * sizeof(Block) <= TableBytes);

  std::filesystem::path Path;
  IoStatistics* Statistics;
  FileDescriptor File;
  std::vector<Block> Blocks;
  std::int64_t End = 0; ///< of the file
};

} // namespace smg
