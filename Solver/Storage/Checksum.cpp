// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Storage/Checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace smg
{

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept
{
  return XXH3_64bits(bytes.data(), bytes.size());
}

} // namespace smg
