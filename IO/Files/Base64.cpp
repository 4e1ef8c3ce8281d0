// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/Base64.h"

namespace smg
{

namespace
{

constexpr char Alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void encode(const std::byte* group, char* characters)
{
  const std::uint32_t bits = std::to_integer<std::uint32_t>(group[0]) << 16 |
                             std::to_integer<std::uint32_t>(group[1]) << 8 |
                             std::to_integer<std::uint32_t>(group[2]);
  for (int i = 0; i < 4; ++i)
  {
    characters[i] = Alphabet[bits >> (18 - 6 * i) & 63];
  }
}

} // namespace

void Base64Encoder::append(std::span<const std::byte> bytes, std::string& text)
{
  while (this->Count > 0 && this->Count < 3 && !bytes.empty())
  {
    this->Group[this->Count++] = bytes.front();
    bytes = bytes.subspan(1);
  }
  if (this->Count == 3)
  {
    this->finish(text);
  }
  const std::size_t groups = bytes.size() / 3;
  const std::size_t begin = text.size();
  text.resize(begin + 4 * groups);
  for (std::size_t i = 0; i < groups; ++i)
  {
    encode(bytes.data() + 3 * i, text.data() + begin + 4 * i);
  }
  for (const std::byte byte : bytes.subspan(3 * groups))
  {
    this->Group[this->Count++] = byte;
  }
}

void Base64Encoder::finish(std::string& text)
{
  if (this->Count > 0)
  {
    char characters[4];
    encode(this->Group.data(), characters);
    // For n bytes, n + 1 characters carry data.
    text.append(characters, this->Count + 1).append(3 - this->Count, '=');
  }
  this->Group = {};
  this->Count = 0;
}

} // namespace smg
