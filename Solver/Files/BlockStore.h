// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/State.h"
#include "smg/Export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * A scratch file of numbered blocks that are written, rewritten and read in any order. A block
 * keeps its place unless it grows. Blocks that were not written have no bytes. Each number may have
 * a block in two generations, which have places of their own: one may be read while another thread
 * writes the other.
 *
 * The file is unnamed: it disappears with this object or the program. In a kept folder it has a
 * name, and another program can read it after save(). Checksums (XXH3) verify that the bytes read
 * are those written.
 */
class SMG_EXPORT BlockStore
{
public:
  /** Memory for each block of a generation, with room for more. */
  static constexpr std::int64_t TableBytes = 64;

  /** An unnamed file in the folder of `path`, which is its name in messages. */
  BlockStore(std::filesystem::path path, IoStatistics& statistics)
    : Path(std::move(path))
    , Statistics(&statistics)
    , File(FileDescriptor::createNameless(this->Path.parent_path()))
  {
  }
  /** A file of `folder`. */
  BlockStore(const ScratchFolder& folder, const std::string& name, IoStatistics& statistics)
    : Path(folder.path() / name)
    , Statistics(&statistics)
    , File(folder.file(name))
  {
  }

  void write(std::int64_t index, std::span<const std::byte> bytes, int generation = 0);
  /** Bytes of a block; 0 if it was not written. */
  std::size_t bytes(std::int64_t index, int generation = 0) const;
  /** Reads a block of exactly this size. */
  void read(std::int64_t index, std::span<std::byte> bytes, int generation = 0);
  /** Announces reads of the blocks [begin, end), as far as they follow each other in the file and
   * have at most 192 KiB, so that the system starts to load them from disk. Returns the first one
   * that was not announced. */
  std::int64_t willRead(std::int64_t begin, std::int64_t end, int generation = 0) const;

  /** Waits until the disk has all blocks, and saves their places. */
  void save(StateWriter& state);
  /** Restores the places. */
  void load(StateReader& state);
  /** Reads a block after load(), and lets the state fail if it is not what was written. */
  void check(
    StateReader& state, std::int64_t index, std::span<std::byte> bytes, int generation = 0) const;

private:
  struct Block
  {
    std::int64_t offset = 0;
    std::uint64_t checksum = 0;
    std::size_t bytes = 0;
    std::size_t room = 0; ///< capacity in bytes
  };
  static_assert(2 * sizeof(Block) <= TableBytes);

  /** One without bytes if it was not written. */
  Block at(std::int64_t index, int generation) const;

  std::filesystem::path Path;
  IoStatistics* Statistics;
  FileDescriptor File;
  std::array<std::vector<Block>, 2> Blocks; ///< of each generation
  std::int64_t End = 0;                     ///< of the file
  bool Unsynced = false;                    ///< something was written since save()
};

} // namespace smg
