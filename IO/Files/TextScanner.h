// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/External/Workspace.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/LineEnds.h"
#include "Solver/Core/Workers.h"
#include "Solver/Memory/Pool.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace smg
{

/** What the characters of a text are for. */
class CharacterKinds
{
public:
  enum Kind : std::uint8_t
  {
    Letter, ///< of a word
    Blank,
    LineEnd,
    Comment ///< begins one up to the end of the line, also directly after a word
  };

  /** `comment`: 0: no comments. `lineEnd`: LF, or CR in texts that have it alone; the other one is
   * a blank. */
  explicit CharacterKinds(char comment, char lineEnd = '\n')
    : End(lineEnd)
  {
    for (const unsigned char c : { ' ', '\t', '\r', '\n', '\f', '\v' })
    {
      this->Kinds[c] = Blank;
    }
    this->Kinds[static_cast<unsigned char>(lineEnd)] = LineEnd;
    if (comment)
    {
      this->Kinds[static_cast<unsigned char>(comment)] = Comment;
    }
  }

  Kind operator()(char c) const { return this->Kinds[static_cast<unsigned char>(c)]; }
  /** The character that ends lines. */
  char lineEnd() const { return this->End; }

private:
  std::array<Kind, 256> Kinds{};
  char End;
};

/** A word of a text block, as a number if it is one. */
struct TextWord
{
  enum Kind : std::uint8_t
  {
    Other,
    Integer, ///< which is the same as a double
    Real     ///< finite
  };

  std::uint32_t begin;  ///< in the block
  std::uint32_t length; ///< bytes
  std::uint32_t line;   ///< the line ends of the block before it
  Kind kind;
  union
  {
    std::int64_t integer;
    double real;
  };
};

/** Text up to a line's end, and the words at its begin: all of them, unless they are very many. */
struct TextBlock
{
  std::vector<char> text;
  std::vector<TextWord> words;
};

/**
 * The lines of a text in blocks, whose words other threads find and convert to numbers while the
 * owner takes the blocks before them.
 */
class WordPrefetch
{
public:
  static constexpr std::size_t BlockBytes = std::size_t(64) << 10;

  /** Whether there are threads and memory for it. */
  static bool isPossible(const Workspace& workspace)
  {
    return workspace.itemsAtOnce(MemoryBytes) > 1;
  }

  /** From `offset` on, which is not inside of a word or a comment. The file must outlive it; its
   * window moves. */
  WordPrefetch(InputFile& file, Workspace& workspace, CharacterKinds kinds, std::size_t offset);

  /** The next block, valid until the next call; null at the end of the file, or where the rest of
   * a line is longer than a block. Throws Error, Cancelled. */
  const TextBlock* next();

private:
  /** The maximum number of words that are found in a block: as lines of a mesh have. */
  static constexpr std::size_t MaxWords = BlockBytes / 4;
  static constexpr std::int64_t MemoryBytes = BlockBytes + MaxWords * sizeof(TextWord);

  static void findWords(TextBlock& block, const CharacterKinds& kinds);
  /** Reads the text of the next block; returns whether there is one. */
  bool read();

  InputFile& File;
  std::size_t Offset;
  const char LineEnd;
  const std::int64_t AtOnce; ///< blocks
  Reservation Reserved;
  TextBlock Current;
  OrderedJobs<TextBlock> Blocks;
};

/** The byte order mark that some editors write at the begin of UTF-8 texts. */
inline constexpr std::string_view ByteOrderMark = "\xEF\xBB\xBF";

/**
 * Reads an InputFile as text: tokens separated by blanks, numbers, lines. Tracks the line number
 * for error messages. Lines end with LF, CR LF or CR; an initial byte order mark is skipped.
 *
 * It reads from the window of the file: after other requests to the file, moveTo() must be called.
 * A returned token is valid until the next reading call. With the threads of a workspace, tokens of
 * a long text are found and converted ahead, unless a line is very long.
 */
class TextScanner
{
public:
  /** The maximum length of a token. */
  static constexpr std::size_t MaxTokenBytes = std::size_t(64) << 10;

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
  /** The rest of the line without its end and without consuming it, valid until the next reading
   * call; none if it has more than MaxTokenBytes bytes. */
  std::optional<std::string_view> restOfLine();
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

  /** A count of following items, each of at least `minBytes` bytes: an error if it is negative or
   * more than the rest of the file can hold. */
  std::int64_t count(const char* what, std::size_t minBytes);
  /** The same check of a count that has been read. */
  void requireRoom(std::int64_t count, std::size_t minBytes, const char* what) const
  {
    if (!fitsInFile(count, minBytes, this->left()))
    {
      this->fail(countError(count, what, this->left()));
    }
  }

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
  /** Calls `read`; a MeshError gets its line. */
  template <class Read>
  void locateErrors(Read&& read) const
  {
    try
    {
      read();
    }
    catch (const MeshError& error)
    {
      this->failAt(error.line() > 0 ? error.line() : this->Line, error.what());
    }
  }

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
  std::unique_ptr<WordPrefetch> Ahead;
  // The block of `Ahead` with the bytes above, if there is one.
  const char* Text = nullptr;
  std::int64_t TextLine = 0; ///< the number of its first line
  const TextWord* Next = nullptr;
  const TextWord* WordsEnd = nullptr;
};

/** The parsers do not accept a leading plus sign, which occurs in files. */
inline const char* afterPlus(std::string_view word)
{
  return word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
}

/** A whole word as a number that the type represents, if it is one. */
template <class T>
std::optional<T> parseWhole(std::string_view word)
{
  const char* end = word.data() + word.size();
  T value{};
  const auto result = std::from_chars(afterPlus(word), end, value);
  return !word.empty() && result.ec == std::errc() && result.ptr == end ? std::optional(value)
                                                                        : std::nullopt;
}

/** A whole word as an integer, if it is one of 64 bits. */
inline std::optional<std::int64_t> parseInteger(std::string_view word)
{
  return parseWhole<std::int64_t>(word);
}

/** A whole word as a finite number, if it is one. */
inline std::optional<double> parseFinite(std::string_view word)
{
  const char* end = word.data() + word.size();
  double value = 0.0;
  const auto result = fast_float::from_chars(afterPlus(word), end, value);
  const bool isNumber = !word.empty() && result.ec == std::errc() && result.ptr == end;
  return isNumber && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Functions to detect text formats by their first bytes.

inline constexpr std::string_view Blanks = " \t\r\f\v\n";

inline bool isBlank(char c)
{
  return Blanks.find(c) != std::string_view::npos;
}

/** The text without a byte order mark. */
inline std::string_view withoutMark(std::string_view text)
{
  return text.substr(text.starts_with(ByteOrderMark) ? ByteOrderMark.size() : 0);
}

/** The text from its first non-blank character on. */
inline std::string_view trimmed(std::string_view text)
{
  return text.substr(std::min(text.find_first_not_of(Blanks), text.size()));
}

/** The text without byte order mark, from its first non-blank character on. */
inline std::string_view textStart(std::string_view bytes)
{
  return trimmed(withoutMark(bytes));
}

/** The same from the first line on that is not a comment (beginning with #). */
inline std::string_view textAfterComments(std::string_view bytes)
{
  std::string_view text = textStart(bytes);
  const char lineEnd = lineEndOf(text);
  while (text.starts_with('#'))
  {
    text = trimmed(afterLine(text, lineEnd));
  }
  return text;
}

} // namespace smg
