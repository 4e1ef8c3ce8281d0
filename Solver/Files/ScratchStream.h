// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"
#include "Solver/Files/IoStatistics.h"
#include "Solver/Files/ScratchFolder.h"
#include "Solver/Files/State.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace smg
{

/**
 * A scratch file of blocks of any size. A pass reads them from first to last, with read-ahead, and
 * may at the same time append the blocks that the next pass reads. The generation that is read is
 * not modified until the pass ends: a block takes the place of the block with the same index in the
 * generation before, if it fits. Pages in the cache of the system are thus overwritten instead of
 * released and allocated again.
 *
 * The file is unnamed: it disappears with the stream or the program. In a kept folder it has a
 * name, and after save() another program can read the generation of the last rewriting pass, as
 * long as no second rewriting pass has begun. Checksums (XXH3) verify that the bytes read are those
 * written.
 */
class SMG_EXPORT ScratchStream
{
public:
  /** An unnamed file in the folder of `path`, which is its name in messages. */
  ScratchStream(std::filesystem::path path, IoStatistics& statistics)
    : Path(std::move(path))
    , Statistics(&statistics)
    , File(FileDescriptor::createNameless(this->Path.parent_path()))
  {
  }
  /** A file of `folder`. */
  ScratchStream(const ScratchFolder& folder, const std::string& name, IoStatistics& statistics)
    : Path(folder.path() / name)
    , Statistics(&statistics)
    , File(folder.file(name))
  {
  }

  /** Restarts reading at the first block; with `rewrite`, also appending. */
  void startPass(bool rewrite);
  void append(std::span<const std::byte> block);
  /** Bytes of the next block to read. */
  std::size_t nextBytes() const;
  void read(std::span<std::byte> block);
  /** Bytes of block `index` of the last rewriting pass. */
  std::size_t bytes(std::int64_t index) const;
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
  struct Block
  {
    std::int64_t offset = 0;
    std::uint64_t checksum = 0;
    std::size_t bytes = 0;
    std::size_t room = 0; ///< capacity in bytes
  };
  struct Generation
  {
    std::vector<Block> blocks;
    std::int64_t count = 0; ///< blocks in use; the others are reserved for later ones

    template <class State>
    void exchange(State& state)
    {
      state(this->blocks, this->count);
    }
  };

  /** Bytes requested from the system at once. */
  static constexpr std::size_t ReadAheadBytes = std::size_t(192) << 10;

  const Block& block(std::int64_t index) const
  {
    return this->Last.blocks.at(static_cast<std::size_t>(index));
  }
  /** The next block to write, with room for `bytes` bytes. */
  Block& place(std::size_t bytes);
  void readAhead();
  void checkPlaces(const Generation& generation, const StateReader& state) const;

  std::filesystem::path Path;
  IoStatistics* Statistics;
  FileDescriptor File;
  Generation Last, Coming; // of the last rewriting pass, and of the current one
  std::int64_t End = 0;    // of the file
  bool Rewriting = false;
  bool Unsynced = false; // something was written since save()
  std::int64_t Next = 0;
  std::int64_t Ahead = 0, Requested = 0; // first block of the last request, and its end
};

} // namespace smg
