// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/FileDescriptor.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace smg
{

/** Reads a file from begin to end through a buffer, as bytes or as lines. */
class SequentialInput
{
public:
  /** The maximum number of characters of a line. */
  static constexpr std::size_t MaxLine = std::size_t(64) << 10;

  explicit SequentialInput(const std::filesystem::path& path);

  std::string name() const { return this->File.path().string(); }
  const FileDescriptor& file() const { return this->File; }
  std::int64_t size() const { return this->Size; }
  /** The offset in the file of the next byte. */
  std::int64_t position() const { return this->BufferOffset + std::int64_t(this->Begin); }
  void moveTo(std::int64_t position);

  /** The next bytes without consuming them: `count`, or fewer if the file ends before. */
  std::span<const std::byte> peek(std::size_t count);
  void skip(std::size_t count) { this->Begin += count; }

  /** Reads a line without its line end (LF, CR LF or CR), valid until the next call; returns false
   * at the end of the file. Throws Error for a line that is too long. */
  bool nextLine(std::string_view& line);
  /** The number of the last line, from 1. */
  std::int64_t lineNumber() const { return this->Line; }

private:
  /** Reads until `count` bytes are buffered or the file ends. */
  void fill(std::size_t count);

  FileDescriptor File;
  std::int64_t Size = 0;
  std::vector<std::byte> Buffer;
  std::int64_t BufferOffset = 0;  ///< offset in the file of the first byte of the buffer
  std::size_t Begin = 0, End = 0; ///< of the unread bytes in the buffer
  std::int64_t Line = 0;
  char LineEnd = '\n'; ///< once the first line has been read
};

/** Splits a line of text into words and numbers separated by white space. */
class Tokens
{
public:
  explicit Tokens(std::string_view line)
    : Rest(line)
  {
  }

  /** The next word; empty at the end. */
  std::string_view word()
  {
    while (!this->Rest.empty() && isSpace(this->Rest.front()))
    {
      this->Rest.remove_prefix(1);
    }
    std::size_t length = 0;
    while (length < this->Rest.size() && !isSpace(this->Rest[length]))
    {
      length++;
    }
    const std::string_view word = this->Rest.substr(0, length);
    this->Rest.remove_prefix(length);
    return word;
  }

  /** The remaining text. */
  std::string_view rest() const { return this->Rest; }

  /** Reads a number; returns false if the next word is not a number of that type. */
  bool number(std::int64_t& value) { return this->parse(value); }
  bool number(std::int32_t& value) { return this->parse(value); }
  bool number(float& value)
  {
    const std::string_view before = this->Rest;
    if (this->parse(value))
    {
      return true;
    }
    // Numbers that underflow in single precision are zero, not an error.
    this->Rest = before;
    double wide = 0;
    const bool good = this->parse(wide) && wide <= std::numeric_limits<float>::max() &&
                      wide >= -std::numeric_limits<float>::max();
    value = good ? static_cast<float>(wide) : value;
    return good;
  }
  bool number(double& value) { return this->parse(value); }

private:
  static bool isSpace(char c)
  {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
  }

  template <class T>
  bool parse(T& value)
  {
    std::string_view word = this->word();
    if (word.size() > 1 && word[0] == '+' && word[1] != '-')
    {
      word.remove_prefix(1);
    }
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return !word.empty() && error == std::errc() && stop == end;
  }

  std::string_view Rest;
};

} // namespace smg
