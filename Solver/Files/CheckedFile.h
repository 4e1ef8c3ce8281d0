// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/Checksum.h"
#include "Solver/Files/FileDescriptor.h"
#include "smg/Export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace smg
{

class StateReader;
class StateWriter;

/**
 * A scratch file that grows at its end and is read anywhere. The checksum (XXH3) of each grain of
 * it is in memory and verifies that the bytes read are those written. Reads of whole grains cost
 * least.
 *
 * The file is unnamed and disappears with this object or the program, unless a checkpoint saves it.
 */
class SMG_EXPORT CheckedFile
{
public:
  /** The checksums take 0.05 % of the bytes. */
  static constexpr std::size_t GrainBytes = std::size_t(16) << 10;
  /** The length of the longest read that starts at `offset`, ends with a grain and has at most
   * `most` bytes; `most` if there is none. */
  static std::size_t untilGrain(std::int64_t offset, std::size_t most);

  /** Creates the file in `folder`. Throws Error. */
  void create(const std::filesystem::path& folder);
  bool isOpen() const { return this->File.isOpen(); }
  std::int64_t size() const { return this->End; }

  /** Throws Error. */
  void append(std::span<const std::byte> bytes);
  /** The next bytes are appended at the beginning of the file. */
  void restart();
  /** Reads exactly these bytes, which must have been appended. Throws Error. */
  void read(std::int64_t offset, std::span<std::byte> bytes) const;

  /** Gives the file a name in the same file system if it has none, waits until the disk has it, and
   * saves what load() needs. Nothing may be appended afterwards. */
  void save(StateWriter& state, const std::filesystem::path& path);
  /** Opens the file that save() named and compares its content with the checksums. */
  void load(StateReader& state, const std::filesystem::path& path);

private:
  static std::int64_t grainAt(std::int64_t offset) { return offset / std::int64_t(GrainBytes); }
  static std::int64_t beginOf(std::int64_t grain) { return grain * std::int64_t(GrainBytes); }
  std::size_t bytesOf(std::int64_t grain) const;
  /** Reads consecutive grains. */
  void readGrains(std::int64_t first, std::span<std::byte> bytes) const;

  FileDescriptor File;
  std::int64_t End = 0;
  std::vector<std::uint64_t> Sums; // of each grain; the last grain may be short
  RunningChecksum LastSum;
  bool IsNamed = false;
};

} // namespace smg
