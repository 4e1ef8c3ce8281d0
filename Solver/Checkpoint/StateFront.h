// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/Checksum.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace smg
{

/** The first bytes of the file of a state, see Checkpoint. */
struct StateFront
{
  static constexpr std::string_view Magic = "SMGSTATE";
  static constexpr std::uint32_t OrderMark = 0x01020304;
  static constexpr std::uint32_t Version = 6;

  char magic[8];
  std::uint32_t version;
  std::uint32_t order;
  std::int64_t steps;
  std::int64_t bytes;
  std::uint64_t checksum;      ///< of the bytes
  std::uint64_t frontChecksum; ///< of all bytes before this one

  std::uint64_t expectedChecksum() const
  {
    return smg::checksum(
      std::as_bytes(std::span(this, 1)).first(offsetof(StateFront, frontChecksum)));
  }
};
static_assert(sizeof(StateFront) == 48);

} // namespace smg
