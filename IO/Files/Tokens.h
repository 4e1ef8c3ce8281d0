// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>

namespace smg
{

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
