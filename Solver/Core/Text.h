// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

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

/** "34,834" */
inline std::string groupedDigits(std::int64_t number)
{
  std::string digits = std::to_string(number);
  const std::ptrdiff_t first = number < 0 ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > first; at -= 3)
  {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return digits;
}

/** "1 point is", "7 points are": the number with the words for one or for several. */
inline std::string counted(std::int64_t number, const std::string& one, const std::string& several)
{
  return std::to_string(number) + ' ' + (number == 1 ? one : several);
}

/** "a, b or c" of texts or numbers. */
inline std::string listed(const auto& words, const std::string& conjunction)
{
  std::string list;
  const auto count = static_cast<std::size_t>(std::size(words));
  for (std::size_t i = 0; const auto& word : words)
  {
    list += i == 0 ? "" : i + 1 < count ? ", " : ' ' + conjunction + ' ';
    if constexpr (requires { std::to_string(word); })
    {
      list += std::to_string(word);
    }
    else
    {
      list += word;
    }
    ++i;
  }
  return list;
}

/** "robin[0] (fin)": entry `index` of the list `key` of a description, with the groups of its
 * place; without these "robin[0]". */
inline std::string nameOfEntry(
  const std::string& key, std::size_t index, const std::string& groups = "")
{
  return key + '[' + std::to_string(index) + ']' + (groups.empty() ? "" : " (" + groups + ')');
}

/** The shortest text that reads back exactly, as of the same type. */
template <class Real>
std::string shortest(Real number)
{
  char text[64];
  return { text, std::to_chars(std::begin(text), std::end(text), number).ptr };
}

/** The bytes of the UTF-8 character at the beginning of a text; 0 if there is none (Unicode 15.0,
 * table 3-7: neither overlong nor a surrogate). */
inline std::size_t utf8Bytes(std::string_view text)
{
  const auto byte = [&](std::size_t i)
  { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80)
  {
    return text.empty() ? 0 : 1;
  }
  const std::size_t length = first < 0xC2   ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  const unsigned least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i < length; ++i)
  {
    if (byte(i) < (i == 1 ? least : 0x80) || byte(i) > (i == 1 ? most : 0xBF))
    {
      return 0;
    }
  }
  return length;
}

/** Whether a character of UTF-8 controls a terminal: C0, DEL or C1, which begins with C2. */
inline bool isControl(std::string_view character)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  return character.size() == 1 ? byte(0) < 32 || byte(0) == 127
                               : character.size() == 2 && byte(0) == 0xC2 && byte(1) < 0xA0;
}

/** The text with `instead` for each character that does not satisfy `stays`, and for each byte that
 * belongs to no character of UTF-8. */
template <class Stays>
std::string replaced(std::string_view text, std::string_view instead, Stays stays)
{
  std::string result;
  while (!text.empty())
  {
    const std::size_t length = utf8Bytes(text);
    const std::string_view character = text.substr(0, length);
    result += length > 0 && stays(character) ? character : instead;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

/** The text in one line, without control characters and bytes that are not UTF-8: for whatever
 * shows what a file has said, in a terminal or an error message. */
inline std::string oneLine(std::string text)
{
  for (char& c : text)
  {
    c = c == '\n' || c == '\r' ? ' ' : c;
  }
  return replaced(text, "?", [](std::string_view character) { return !isControl(character); });
}

} // namespace smg
