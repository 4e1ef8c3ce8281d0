// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace smg
{

/** The checksum of all files of the library: XXH3, 64 bits. */
std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

} // namespace smg
