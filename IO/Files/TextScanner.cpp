// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/TextScanner.h"

#include "smg/Error.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace smg
{

namespace
{

/** from_chars does not accept a leading plus sign, which occurs in files. */
const char* afterPlus(std::string_view token)
{
  return token.data() + (token.size() > 1 && token[0] == '+' && token[1] != '-' ? 1 : 0);
}

} // namespace

TextScanner::TextScanner(InputFile& file, char comment, std::size_t begin, std::int64_t line)
  : File(file)
  , Line(line)
{
  for (const unsigned char c : { ' ', '\t', '\r', '\f', '\v' })
  {
    this->Kinds[c] = Kind::Blank;
  }
  this->Kinds['\n'] = Kind::LineEnd;
  if (comment)
  {
    this->Kinds[static_cast<unsigned char>(comment)] = Kind::Comment;
  }
  const bool isMarked = begin == 0 && file.at(0, ByteOrderMark.size()).starts_with(ByteOrderMark);
  this->moveTo(isMarked ? ByteOrderMark.size() : begin);
}

void TextScanner::moveTo(std::size_t offset)
{
  const std::string_view bytes =
    this->File.at(std::min(offset, this->File.size()), MostTokenBytes + 1);
  this->At = bytes.data();
  this->End = bytes.data() + bytes.size();
  this->EndOffset = std::min(offset, this->File.size()) + bytes.size();
  this->FarEnough =
    this->EndOffset == this->File.size() ? this->End : this->End - (MostTokenBytes + 1);
}

/** Loads at least one complete token, if any; returns false at the end of the file. */
bool TextScanner::refill()
{
  if (this->At > this->FarEnough)
  {
    this->moveTo(this->offset());
  }
  return this->At < this->End;
}

void TextScanner::skipToLineEnd()
{
  do
  {
    const void* newline =
      std::memchr(this->At, '\n', static_cast<std::size_t>(this->End - this->At));
    this->At = newline ? static_cast<const char*>(newline) : this->End;
  } while (this->At == this->End && this->refill());
}

void TextScanner::skipBlanks()
{
  do
  {
    while (this->At < this->End && this->kindOf(*this->At) == Kind::Blank)
    {
      ++this->At;
    }
  } while (this->At == this->End && this->refill());
  if (this->At < this->End && this->kindOf(*this->At) == Kind::Comment)
  {
    this->skipToLineEnd();
  }
}

/** The token that begins here, without consuming it; empty if there is none. */
std::string_view TextScanner::tokenHere()
{
  this->refill();
  const char* end = this->At;
  while (end < this->End && this->kindOf(*end) == Kind::Token)
  {
    ++end;
  }
  const auto length = static_cast<std::size_t>(end - this->At);
  if (length > MostTokenBytes)
  {
    this->fail("a word has more than " + std::to_string(MostTokenBytes) +
               " bytes: this is no text, or the file is damaged");
  }
  return { this->At, length };
}

std::string_view TextScanner::tokenInLine()
{
  this->skipBlanks();
  const std::string_view token = this->tokenHere();
  this->At += token.size();
  return token;
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
  return this->tokenHere();
}

void TextScanner::skipLine()
{
  this->skipToLineEnd();
  if (this->At < this->End)
  {
    ++this->At;
    ++this->Line;
  }
}

double TextScanner::toNumber(std::string_view token, const char* what, bool finite) const
{
  if (token.empty())
  {
    this->fail(std::string("the file or line ends where ") + what + " should be");
  }
  const char* end = token.data() + token.size();
  double value = 0.0;
  const auto result = fast_float::from_chars(afterPlus(token), end, value);
  if (result.ptr == end && result.ec == std::errc::result_out_of_range && std::abs(value) < 1.0)
  {
    return value; // underflow to zero
  }
  if (result.ptr == end && (result.ec == std::errc::result_out_of_range || !std::isfinite(value)))
  {
    if (finite)
    {
      this->fail(inQuotes(token) + " is not finite, where " + what + " should be");
    }
    return value;
  }
  if (result.ec != std::errc() || result.ptr != end)
  {
    this->fail(inQuotes(token) + " is no number, where " + what + " should be");
  }
  return value;
}

std::optional<double> TextScanner::finiteNumber(std::string_view token)
{
  const char* end = token.data() + token.size();
  double value = 0.0;
  const auto result = fast_float::from_chars(afterPlus(token), end, value);
  const bool isNumber = !token.empty() && result.ec == std::errc() && result.ptr == end;
  return isNumber && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::int64_t TextScanner::toInteger(std::string_view token, const char* what) const
{
  if (token.empty())
  {
    this->fail(std::string("the file or line ends where ") + what + " should be");
  }
  const char* end = token.data() + token.size();
  std::int64_t value = 0;
  const auto result = std::from_chars(afterPlus(token), end, value);
  if (result.ec != std::errc() || result.ptr != end)
  {
    this->fail(inQuotes(token) + " is no integer, where " + what + " should be");
  }
  return value;
}

std::int64_t TextScanner::count(const char* what, std::size_t leastBytes)
{
  const std::int64_t value = this->integer(what);
  // The last item of a file needs no line end.
  if (value < 0 || static_cast<std::uint64_t>(value) > (this->left() + 1) / leastBytes)
  {
    this->fail(std::to_string(value) + " cannot be " + what + ": the file has " +
               std::to_string(this->left()) +
               " more bytes, it is truncated or the number is wrong");
  }
  return value;
}

void TextScanner::fail(const std::string& sentence) const
{
  this->failAt(this->Line, sentence);
}

void TextScanner::failAt(std::int64_t line, const std::string& sentence) const
{
  throw Error(this->File.name() + ", line " + std::to_string(line) + ": " + sentence);
}

} // namespace smg
