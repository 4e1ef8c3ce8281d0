// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace smg
{

/**
 * Encodes bytes that come in parts as one unit of base64 (RFC 4648, with padding, without line
 * breaks). At most two bytes are kept from a part to the next.
 */
class Base64Encoder
{
public:
  /** Number of characters of the unit that encodes so many bytes. */
  static constexpr std::int64_t encodedSize(std::int64_t bytes) { return (bytes + 2) / 3 * 4; }

  /** Adds to `text` the characters of the next bytes, as far as they are certain. */
  void append(std::span<const std::byte> bytes, std::string& text);

  /** Adds to `text` the characters of the bytes kept, with padding; a new unit may follow. */
  void finish(std::string& text);

private:
  std::array<std::byte, 3> Group{};
  std::size_t Count = 0; ///< bytes of the group that have come
};

} // namespace smg
