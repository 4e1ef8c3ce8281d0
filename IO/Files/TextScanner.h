// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/CharacterKinds.h"
#include "IO/Files/InQuotes.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/WordsAhead.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace smg
{

/** The byte order mark that some editors write at the begin of UTF-8 texts. */
inline constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

/**
 * Reads an InputFile as text: tokens separated by blanks, numbers, lines. Tracks the line number
 * for error messages. A carriage return counts as a blank; an initial byte order mark is skipped.
 *
 * It reads from the window of the file: after other requests to the file, moveTo() must be called.
 * A returned token is valid until the next reading call. With the threads of a workspace, tokens of
 * a long text are found and converted ahead, unless a line is very long.
 */
class TextScanner
{
public:
  /** The maximum length of a token. */
  static constexpr std::size_t MostTokenBytes = std::size_t(64) << 10;

  /** Starts at byte `begin`, which is in line `line` (counted from 1). `comment` starts a comment
   * up to the end of the line; 0: no comments. `helpers`: whose threads find tokens ahead; it must
   * outlive the scanner; null: none. */
  explicit TextScanner(InputFile& file, char comment = '\0', Workspace* helpers = nullptr,
    std::size_t begin = 0, std::int64_t line = 1);

  /** Continues at byte `offset` of the file, with consecutive line numbers. */
  void moveTo(std::size_t offset);

  /** The next token of this line; empty at the end of the line. */
  std::string_view tokenInLine();
  /** The next token of this or a later line; empty at the end of the file. */
  std::string_view token()
  {
    const std::string_view token = this->peek();
    this->At += token.size();
    return token;
  }
  /** The next token of this or a later line without consuming it; empty at the end of the file. */
  std::string_view peek()
  {
    if (const TextWord* word = this->nextWord())
    {
      this->At = this->Text + word->begin;
      this->Line = this->TextLine + word->line;
      return { this->At, word->length };
    }
    return this->peekSlowly();
  }
  /** Skips the rest of the line and its end. */
  void skipLine();
  /** Whether only blanks, comments and line ends remain. */
  bool atEnd() { return this->peek().empty(); }

  /** The next token as a finite number. Error messages say that it should be `what`. */
  double number(const char* what) { return this->toNumber(this->token(), what); }
  std::int64_t integer(const char* what) { return this->toInteger(this->token(), what); }
  /** The same for a token that has been read; an empty one is the end of the file or line. */
  double toNumber(std::string_view token, const char* what, bool finite = true) const;
  std::int64_t toInteger(std::string_view token, const char* what) const;

  /** A count of following items, each of at least `leastBytes` bytes: an error if it is negative or
   * more than the rest of the file can hold. */
  std::int64_t count(const char* what, std::size_t leastBytes);

  /** The offset in the file of the next byte. */
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
  void readFrom(std::size_t offset);
  void startAhead();
  void readAhead();
  bool refill();
  void skipBlanks();
  void skipToLineEnd();
  std::string_view tokenHere();
  std::string_view peekSlowly();
  /** The next token, if it was found ahead, in this or a later line; null otherwise. */
  const TextWord* nextWord()
  {
    while (this->Next < this->WordsEnd && this->Text + this->Next->begin < this->At)
    {
      ++this->Next;
    }
    return this->Next < this->WordsEnd ? this->Next : nullptr;
  }
  /** What was found ahead of a token that was read last, null if that is unknown. */
  const TextWord* wordOf(std::string_view token) const
  {
    const bool isLast = this->Next < this->WordsEnd &&
                        token.data() == this->Text + this->Next->begin &&
                        token.size() == this->Next->length;
    return isLast ? this->Next : nullptr;
  }

  InputFile& File;
  // The bytes between At and End are in memory; up to FarEnough, a token that begins there is
  // whole, and one more byte follows it.
  const char* At = nullptr;
  const char* End = nullptr;
  const char* FarEnough = nullptr;
  std::size_t EndOffset = 0;
  std::int64_t Line;
  CharacterKinds Kinds;
  Workspace* Helpers; ///< null: nothing is found ahead
  std::unique_ptr<WordsAhead> Ahead;
  // The block of `Ahead` with the bytes above, if there is one.
  const char* Text = nullptr;
  std::int64_t TextLine = 0; ///< the number of its first line
  const TextWord* Next = nullptr;
  const TextWord* WordsEnd = nullptr;
};

} // namespace smg
