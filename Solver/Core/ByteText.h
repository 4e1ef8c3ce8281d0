// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace smg
{

/** "12 MiB", rounded up. */
inline std::string mebibytes(std::int64_t bytes)
{
  return std::to_string((bytes >> 20) + (bytes % (1 << 20) > 0 ? 1 : 0)) + " MiB";
}

/** "12 MiB (12345678 bytes)". */
inline std::string exactMebibytes(std::int64_t bytes)
{
  return mebibytes(bytes) + " (" + std::to_string(bytes) + " bytes)";
}

} // namespace smg
