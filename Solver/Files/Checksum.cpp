// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/Checksum.h"

#include "smg/Error.h"

#include <string>

#define XXH_INLINE_ALL
#include <xxhash.h>

// XXH3 with 64 bits. XXH_INLINE_ALL compiles it into this file, the only one that includes
// xxhash.h. The checksum finds faults of disks and memory; it is no protection against somebody who
// changes a file on purpose.

namespace smg
{

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept
{
  return XXH3_64bits(bytes.data(), bytes.size());
}

struct RunningChecksum::State
{
  XXH3_state_t xxh;
};

RunningChecksum::RunningChecksum() = default;
RunningChecksum::~RunningChecksum() = default;
RunningChecksum::RunningChecksum(RunningChecksum&& other) noexcept = default;
RunningChecksum& RunningChecksum::operator=(RunningChecksum&& other) noexcept = default;

/** The state of XXH3 has several hundred bytes and an alignment of its own: it exists only while
 * there are bytes. */
void RunningChecksum::restart()
{
  this->Parts.reset();
}

void RunningChecksum::add(std::span<const std::byte> bytes)
{
  if (!this->Parts)
  {
    this->Parts = std::make_unique<State>();
    XXH3_64bits_reset(&this->Parts->xxh);
  }
  XXH3_64bits_update(&this->Parts->xxh, bytes.data(), bytes.size());
}

std::uint64_t RunningChecksum::value() const noexcept
{
  // The checksum of no bytes must be the same in both ways of computing it.
  return this->Parts ? XXH3_64bits_digest(&this->Parts->xxh) : checksum({});
}

void throwDamagedBlock(const std::filesystem::path& path, std::int64_t block)
{
  throw Error(path.string() + ": block " + std::to_string(block) +
              " differs from what was written: check the disk for faults, or use another one.");
}

} // namespace smg
