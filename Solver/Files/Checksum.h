// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace smg
{

/** The checksum of all files of the library: XXH3, 64 bits. */
SMG_EXPORT std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

/** The same checksum for bytes that arrive in several parts. */
class SMG_EXPORT RunningChecksum
{
public:
  RunningChecksum();
  ~RunningChecksum();
  RunningChecksum(RunningChecksum&& other) noexcept;
  RunningChecksum& operator=(RunningChecksum&& other) noexcept;

  void restart();
  void add(std::span<const std::byte> bytes);
  /** The checksum of all bytes so far. */
  std::uint64_t value() const noexcept;

private:
  struct State;
  std::unique_ptr<State> Parts; // null as long as there are no bytes
};

/** Throws the Error of a block of a scratch file whose checksum is wrong. */
[[noreturn]] SMG_EXPORT void throwDamagedBlock(
  const std::filesystem::path& path, std::int64_t block);

} // namespace smg
