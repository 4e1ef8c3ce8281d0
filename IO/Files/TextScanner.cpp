// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/TextScanner.h"

#include "IO/Files/MicrosoftNumbers.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace smg
{

namespace
{

/** Sets what a word is as a number. */
void convert(std::string_view text, TextWord& word)
{
  word.kind = TextWord::Other;
  const char first = text[0];
  if ((first < '0' || first > '9') && first != '-' && first != '+' && first != '.')
  {
    return;
  }
  // The double of "-0" has a sign.
  if (const auto integer = parseInteger(text); integer && (*integer != 0 || first != '-'))
  {
    word.kind = TextWord::Integer;
    word.integer = *integer;
  }
  else if (const auto real = parseFinite(text))
  {
    word.kind = TextWord::Real;
    word.real = *real;
  }
}

} // namespace

WordPrefetch::WordPrefetch(
  InputFile& file, Workspace& workspace, CharacterKinds kinds, std::size_t offset)
  : File(file)
  , Offset(offset)
  , LineEnd(kinds.lineEnd())
  , AtOnce(workspace.itemsAtOnce(MemoryBytes))
  , Reserved(workspace.pool(), (this->AtOnce + 1) * MemoryBytes)
  , Blocks(
      workspace.workers(), static_cast<std::size_t>(this->AtOnce),
      [kinds](TextBlock& block) { findWords(block, kinds); },
      [this](TextBlock& block) { std::swap(this->Current, block); })
{
}

const TextBlock* WordPrefetch::next()
{
  if (this->Blocks.size() == 0 && !this->read())
  {
    return nullptr;
  }
  this->Blocks.takeOldest();
  while (this->Blocks.size() < this->Blocks.most() && this->read())
  {
  }
  return &this->Current;
}

bool WordPrefetch::read()
{
  if (this->Offset >= this->File.size())
  {
    return false;
  }
  std::string_view text = this->File.at(this->Offset, BlockBytes).substr(0, BlockBytes);
  if (this->Offset + text.size() < this->File.size())
  {
    text = text.substr(0, text.rfind(this->LineEnd) + 1);
  }
  if (text.empty())
  {
    return false;
  }
  TextBlock& block = this->Blocks.next();
  block.text.reserve(BlockBytes);
  block.words.reserve(MaxWords);
  block.text.assign(text.begin(), text.end());
  this->Offset += text.size();
  this->Blocks.submit();
  return true;
}

void WordPrefetch::findWords(TextBlock& block, const CharacterKinds& kinds)
{
  block.words.clear();
  const char* const begin = block.text.data();
  const char* const end = begin + block.text.size();
  std::uint32_t line = 0;
  for (const char* at = begin; at < end && block.words.size() < MaxWords;)
  {
    switch (kinds(*at))
    {
      case CharacterKinds::Letter:
      {
        const char* const word = at;
        while (at < end && kinds(*at) == CharacterKinds::Letter)
        {
          ++at;
        }
        const std::string_view text(word, static_cast<std::size_t>(at - word));
        TextWord& found = block.words.emplace_back();
        found.begin = static_cast<std::uint32_t>(word - begin);
        found.length = static_cast<std::uint32_t>(text.size());
        found.line = line;
        convert(text, found);
        break;
      }
      case CharacterKinds::Comment:
        at = std::find(at, end, kinds.lineEnd());
        break;
      case CharacterKinds::LineEnd:
        ++line;
        [[fallthrough]];
      case CharacterKinds::Blank:
        ++at;
    }
  }
}

TextScanner::TextScanner(
  InputFile& file, char comment, Workspace* helpers, std::size_t begin, std::int64_t line)
  : File(file)
  , Line(line)
  , Kinds(comment, lineEndOf(file.at(begin).substr(0, MaxTokenBytes)))
  , Helpers(helpers)
{
  const bool isMarked = begin == 0 && file.at(0, ByteOrderMark.size()).starts_with(ByteOrderMark);
  this->moveTo(isMarked ? ByteOrderMark.size() : begin);
}

void TextScanner::moveTo(std::size_t offset)
{
  this->Ahead.reset();
  this->Next = this->WordsEnd = nullptr;
  this->readFrom(offset);
}

/** Continues in the window of the file. */
void TextScanner::readFrom(std::size_t offset)
{
  const std::string_view bytes =
    this->File.at(std::min(offset, this->File.size()), MaxTokenBytes + 1);
  this->At = bytes.data();
  this->End = bytes.data() + bytes.size();
  this->EndOffset = std::min(offset, this->File.size()) + bytes.size();
  this->FarEnough =
    this->EndOffset == this->File.size() ? this->End : this->End - (MaxTokenBytes + 1);
}

/** Continues in the next block whose words are found ahead, in the window if there is none. */
void TextScanner::readAhead()
{
  const std::size_t offset = this->offset();
  this->Next = this->WordsEnd = nullptr;
  const TextBlock* const block = this->Ahead->next();
  if (!block)
  {
    this->Ahead.reset();
    this->Helpers = nullptr; // a line is too long, and others may be
    this->readFrom(offset);
    return;
  }
  this->Text = this->At = block->text.data();
  this->End = this->At + block->text.size();
  this->EndOffset = offset + block->text.size();
  // Words do not continue in the next block.
  this->FarEnough = this->EndOffset == this->File.size() ? this->End : this->End - 1;
  this->TextLine = this->Line;
  this->Next = block->words.data();
  this->WordsEnd = this->Next + block->words.size();
}

/** Loads at least one complete token, if any; returns false at the end of the file. */
bool TextScanner::refill()
{
  if (this->At > this->FarEnough)
  {
    if (this->Ahead)
    {
      this->readAhead();
    }
    else
    {
      this->readFrom(this->offset());
    }
  }
  return this->At < this->End;
}

void TextScanner::skipToLineEnd()
{
  do
  {
    const void* newline =
      std::memchr(this->At, this->Kinds.lineEnd(), static_cast<std::size_t>(this->End - this->At));
    this->At = newline ? static_cast<const char*>(newline) : this->End;
  } while (this->At == this->End && this->refill());
}

void TextScanner::skipBlanks()
{
  do
  {
    while (this->At < this->End && this->Kinds(*this->At) == CharacterKinds::Blank)
    {
      ++this->At;
    }
  } while (this->At == this->End && this->refill());
  if (this->At < this->End && this->Kinds(*this->At) == CharacterKinds::Comment)
  {
    this->skipToLineEnd();
  }
}

/** Finds words ahead of here, where no comment is, and a word or a line end begins. */
void TextScanner::startAhead()
{
  const bool isLong = this->EndOffset < this->File.size();
  if (isLong && this->Helpers && !this->Ahead && WordPrefetch::isPossible(*this->Helpers))
  {
    this->Ahead =
      std::make_unique<WordPrefetch>(this->File, *this->Helpers, this->Kinds, this->offset());
  }
}

/** The token that begins here, without consuming it; empty if there is none. */
std::string_view TextScanner::tokenHere()
{
  if (this->At > this->FarEnough)
  {
    this->startAhead();
    this->refill();
  }
  const char* end = this->At;
  while (end < this->End && this->Kinds(*end) == CharacterKinds::Letter)
  {
    ++end;
  }
  const auto length = static_cast<std::size_t>(end - this->At);
  if (length > MaxTokenBytes)
  {
    this->fail("a word has more than " + std::to_string(MaxTokenBytes) +
               " bytes: this is not text, or the file is damaged");
  }
  return { this->At, length };
}

std::string_view TextScanner::tokenInLine()
{
  if (const TextWord* word = this->nextWord())
  {
    if (this->TextLine + word->line != this->Line)
    {
      this->skipBlanks();
      return {};
    }
    this->At = this->Text + word->begin + word->length;
    return { this->Text + word->begin, word->length };
  }
  // Nearly always in what is in memory.
  const char* begin = this->At;
  while (begin < this->FarEnough && this->Kinds(*begin) == CharacterKinds::Blank)
  {
    ++begin;
  }
  const char* end = begin;
  while (end < this->FarEnough && this->Kinds(*end) == CharacterKinds::Letter)
  {
    ++end;
  }
  if (begin < end && end < this->FarEnough && end - begin <= std::ptrdiff_t(MaxTokenBytes))
  {
    this->At = end;
    return { begin, static_cast<std::size_t>(end - begin) };
  }
  this->skipBlanks();
  const std::string_view token = this->tokenHere();
  this->At += token.size();
  return token;
}

std::string_view TextScanner::peekSlowly()
{
  this->skipBlanks();
  while (this->At < this->End && *this->At == this->Kinds.lineEnd())
  {
    ++this->At;
    ++this->Line;
    this->skipBlanks();
  }
  return this->tokenHere();
}

std::optional<std::string_view> TextScanner::restOfLine()
{
  if (this->At > this->FarEnough)
  {
    this->refill();
  }
  const std::string_view text(this->At, static_cast<std::size_t>(this->End - this->At));
  const std::string_view line = text.substr(0, MaxTokenBytes + 1);
  const std::size_t length = std::min(line.find(this->Kinds.lineEnd()), line.size());
  return length > MaxTokenBytes ? std::nullopt : std::optional(line.substr(0, length));
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
  if (const TextWord* word = this->wordOf(token); word && word->kind != TextWord::Other)
  {
    return word->kind == TextWord::Real ? word->real : static_cast<double>(word->integer);
  }
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
  if (const auto other = parseMicrosoft(token))
  {
    if (finite)
    {
      this->fail(inQuotes(token) + " is not finite, where " + what + " should be");
    }
    return *other;
  }
  if (result.ec != std::errc() || result.ptr != end)
  {
    this->fail(inQuotes(token) + " is not a number, where " + what + " should be");
  }
  return value;
}

std::int64_t TextScanner::toInteger(std::string_view token, const char* what) const
{
  if (const TextWord* word = this->wordOf(token); word && word->kind == TextWord::Integer)
  {
    return word->integer;
  }
  if (token.empty())
  {
    this->fail(std::string("the file or line ends where ") + what + " should be");
  }
  const std::optional<std::int64_t> value = parseInteger(token);
  if (!value)
  {
    this->fail(inQuotes(token) + " is not an integer, where " + what + " should be");
  }
  return *value;
}

std::int64_t TextScanner::count(const char* what, std::size_t minBytes)
{
  const std::int64_t value = this->integer(what);
  this->requireRoom(value, minBytes, what);
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
