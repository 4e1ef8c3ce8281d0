// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/** Encodes bytes that are passed in parts as one unit of base64 (RFC 4648, with padding, without
 * line breaks). At most two bytes are kept between parts. */
class SMG_EXPORT Base64Encoder
{
public:
  /** The number of characters of the unit that encodes this many bytes. */
  static constexpr std::int64_t encodedSize(std::int64_t bytes) { return (bytes + 2) / 3 * 4; }

  /** Appends the characters of complete groups of the next bytes to `text`. */
  void append(std::span<const std::byte> bytes, std::string& text);

  /** Appends the characters of the remaining bytes to `text`, with padding; another unit may
   * follow. */
  void finish(std::string& text);

private:
  std::array<std::byte, 3> Group{};
  std::size_t Count = 0; ///< bytes in the incomplete group
};

} // namespace smg
