// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/InQuotes.h"
#include "IO/Files/InputFile.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace smg
{

/** What some editors put before a text to say that it is UTF-8. */
inline constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

/**
 * Reads an InputFile as text: tokens separated by blanks, numbers, lines. Knows the line it is at,
 * for errors. A carriage return counts as a blank; a byte order mark before the text is passed.
 *
 * It reads from the file's window: whoever asks the file for other bytes in between must moveTo()
 * where the text goes on. A token that is given out is valid until the next call that reads.
 */
class TextScanner
{
public:
  /** A token that is longer is refused. */
  static constexpr std::size_t MostTokenBytes = std::size_t(64) << 10;

  /**
   * Begins at byte `begin`, which is in line `line` (counted from 1). `comment` starts a comment
   * that reaches to the end of the line; 0: there are none.
   */
  explicit TextScanner(
    InputFile& file, char comment = '\0', std::size_t begin = 0, std::int64_t line = 1);

  /** Goes on at byte `offset` of the file; the line number goes on as well. */
  void moveTo(std::size_t offset);

  /** The next token of this line; empty at the line's end. */
  std::string_view tokenInLine();
  /** The next token of this or a later line; empty at the end of the file. */
  std::string_view token()
  {
    const std::string_view token = this->peek();
    this->At += token.size();
    return token;
  }
  /** The next token without passing it, over line ends; empty at the end of the file. */
  std::string_view peek();
  /** Passes the rest of the line and its end. */
  void skipLine();
  /** Whether only blanks, comments and line ends are left. */
  bool atEnd() { return this->peek().empty(); }

  /** The next token as a finite number. Errors say that it should be `what`. */
  double number(const char* what) { return this->toNumber(this->token(), what); }
  std::int64_t integer(const char* what) { return this->toInteger(this->token(), what); }
  /** The same for a token that has been read; an empty one is the end of the file or line. */
  double toNumber(std::string_view token, const char* what, bool finite = true) const;
  std::int64_t toInteger(std::string_view token, const char* what) const;
  /** A token as a finite number; nothing if it is none. */
  static std::optional<double> finiteNumber(std::string_view token);

  /**
   * A number of things that follow, each of at least `leastBytes` bytes: refused if negative or
   * more than the rest of the file can hold.
   */
  std::int64_t count(const char* what, std::size_t leastBytes);

  /** Place in the file of what comes next. */
  std::size_t offset() const
  {
    return this->EndOffset - static_cast<std::size_t>(this->End - this->At);
  }
  /** Bytes from there to the end of the file. */
  std::size_t left() const { return this->File.size() - this->offset(); }
  std::int64_t line() const { return this->Line; }

  /** Throws Error: "NAME, line N: SENTENCE". */
  [[noreturn]] void fail(const std::string& sentence) const;
  [[noreturn]] void failAt(std::int64_t line, const std::string& sentence) const;

private:
  enum class Kind : std::uint8_t
  {
    Token,
    Blank,
    LineEnd,
    Comment
  };

  Kind kindOf(char c) const { return this->Kinds[static_cast<unsigned char>(c)]; }
  bool refill();
  void skipBlanks();
  void skipToLineEnd();
  std::string_view tokenHere();

  InputFile& File;
  // Between At and End lies what is in memory; below FarEnough this is a token's most and one more.
  const char* At = nullptr;
  const char* End = nullptr;
  const char* FarEnough = nullptr;
  std::size_t EndOffset = 0;
  std::int64_t Line;
  std::array<Kind, 256> Kinds{};
};

} // namespace smg
