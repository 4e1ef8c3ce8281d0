// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Formats/InQuotes.h"
#include "IO/Import/InputFile.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace smg
{

/**
 * Reads an InputFile as text: tokens separated by blanks, numbers, lines. Knows the line it is at,
 * for errors. A carriage return counts as a blank.
 */
class TextScanner
{
public:
  /**
   * Begins at byte `begin`, which is in line `line` (counted from 1). `comment` starts a comment
   * that reaches to the end of the line; 0: there are none.
   */
  explicit TextScanner(
    InputFile& file, char comment = '\0', std::size_t begin = 0, std::int64_t line = 1);

  /** The next token of this line; empty at the line's end. */
  std::string_view tokenInLine();
  /** The next token of this or a later line; empty at the end of the file. */
  std::string_view token();
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

  /**
   * A number of things that follow, each of at least `leastBytes` bytes: refused if negative or
   * more than the rest of the file can hold.
   */
  std::int64_t count(const char* what, std::size_t leastBytes);

  std::size_t offset() const { return static_cast<std::size_t>(this->At - this->File.begin()); }
  std::int64_t line() const { return this->Line; }

  /** Throws Error: "PATH, line N: SENTENCE". */
  [[noreturn]] void fail(const std::string& sentence) const;
  [[noreturn]] void failAt(std::int64_t line, const std::string& sentence) const;

private:
  void skipBlanks();

  InputFile& File;
  const char* At;
  const char* End;
  std::int64_t Line;
  char Comment;
};

} // namespace smg
