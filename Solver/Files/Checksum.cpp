// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Files/Checksum.h"

#include "smg/Error.h"

#include <string>

#define XXH_INLINE_ALL
#include <xxhash.h>

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
  return this->Parts ? XXH3_64bits_digest(&this->Parts->xxh) : checksum({});
}

void throwDamagedBlock(const std::filesystem::path& path, std::int64_t block)
{
  throw Error(path.string() + ": block " + std::to_string(block) +
              " differs from what was written: check the disk for faults, or use another one.");
}

} // namespace smg
