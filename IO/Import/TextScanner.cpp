// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/TextScanner.h"

#include "Solver/Core/Error.h"

#include <fast_float/fast_float.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace smg
{

namespace
{

bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

/** from_chars knows no leading plus sign, files do. */
const char* afterPlus(std::string_view token)
{
  return token.data() + (token.size() > 1 && token[0] == '+' && token[1] != '-' ? 1 : 0);
}

} // namespace

TextScanner::TextScanner(InputFile& file, char comment, std::size_t begin, std::int64_t line)
  : File(file)
  , At(file.begin() + begin)
  , End(file.end())
  , Line(line)
  , Comment(comment)
{
}

void TextScanner::skipBlanks()
{
  while (this->At < this->End && isBlank(*this->At))
  {
    ++this->At;
  }
  if (this->Comment && this->At < this->End && *this->At == this->Comment)
  {
    const void* newline = std::memchr(this->At, '\n', this->End - this->At);
    this->At = newline ? static_cast<const char*>(newline) : this->End;
  }
}

std::string_view TextScanner::tokenInLine()
{
  this->skipBlanks();
  const char* begin = this->At;
  while (this->At < this->End && *this->At != '\n' && !isBlank(*this->At) &&
         !(this->Comment && *this->At == this->Comment))
  {
    ++this->At;
  }
  return { begin, static_cast<std::size_t>(this->At - begin) };
}

std::string_view TextScanner::peek()
{
  this->skipBlanks();
  while (this->At < this->End && *this->At == '\n')
  {
    ++this->At;
    ++this->Line;
    this->skipBlanks();
  }
  this->File.passed(this->offset());
  const char* begin = this->At;
  const std::string_view token = this->tokenInLine();
  this->At = begin;
  return token;
}

std::string_view TextScanner::token()
{
  const std::string_view token = this->peek();
  this->At += token.size();
  return token;
}

void TextScanner::skipLine()
{
  const void* newline = std::memchr(this->At, '\n', this->End - this->At);
  if (newline)
  {
    this->At = static_cast<const char*>(newline) + 1;
    ++this->Line;
  }
  else
  {
    this->At = this->End;
  }
  this->File.passed(this->offset());
}

double TextScanner::toNumber(std::string_view token, const char* what, bool finite) const
{
  const char* end = token.data() + token.size();
  double value = 0.0;
  const auto result = fast_float::from_chars(afterPlus(token), end, value);
  if (token.empty())
  {
    this->fail(std::string("the file or line ends where ") + what + " should be");
  }
  if (result.ec != std::errc() || result.ptr != end)
  {
    this->fail(inQuotes(token) + " is no number, where " + what + " should be");
  }
  if (finite && !std::isfinite(value))
  {
    this->fail(inQuotes(token) + " is not finite, where " + what + " should be");
  }
  return value;
}

std::int64_t TextScanner::toInteger(std::string_view token, const char* what) const
{
  const char* end = token.data() + token.size();
  std::int64_t value = 0;
  const auto result = std::from_chars(afterPlus(token), end, value);
  if (token.empty())
  {
    this->fail(std::string("the file or line ends where ") + what + " should be");
  }
  if (result.ec != std::errc() || result.ptr != end)
  {
    this->fail(inQuotes(token) + " is no integer, where " + what + " should be");
  }
  return value;
}

std::int64_t TextScanner::count(const char* what, std::size_t leastBytes)
{
  const std::int64_t value = this->integer(what);
  const std::size_t left = static_cast<std::size_t>(this->End - this->At);
  // The last thing of a file needs no line end.
  if (value < 0 || static_cast<std::uint64_t>(value) > (left + 1) / leastBytes)
  {
    this->fail(std::to_string(value) + " cannot be " + what + ": the file has " +
               std::to_string(left) + " more bytes, it is truncated or the number is wrong");
  }
  return value;
}

void TextScanner::fail(const std::string& sentence) const
{
  this->failAt(this->Line, sentence);
}

void TextScanner::failAt(std::int64_t line, const std::string& sentence) const
{
  throw Error(this->File.path().string() + ", line " + std::to_string(line) + ": " + sentence);
}

} // namespace smg
