// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/WordsAhead.h"

#include "IO/Files/ParseNumber.h"

#include <algorithm>
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

WordsAhead::WordsAhead(
  InputFile& file, Workspace& workspace, CharacterKinds kinds, std::size_t offset)
  : File(file)
  , Offset(offset)
  , AtOnce(workspace.itemsAtOnce(MemoryBytes))
  , Reserved(workspace.pool(), (this->AtOnce + 1) * MemoryBytes)
  , Blocks(
      workspace.workers(), static_cast<std::size_t>(this->AtOnce),
      [kinds](TextBlock& block) { findWords(block, kinds); },
      [this](TextBlock& block) { std::swap(this->Current, block); })
{
}

const TextBlock* WordsAhead::next()
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

bool WordsAhead::read()
{
  if (this->Offset >= this->File.size())
  {
    return false;
  }
  std::string_view text = this->File.at(this->Offset, BlockBytes).substr(0, BlockBytes);
  if (this->Offset + text.size() < this->File.size())
  {
    text = text.substr(0, text.rfind('\n') + 1);
  }
  if (text.empty())
  {
    return false;
  }
  TextBlock& block = this->Blocks.next();
  block.text.reserve(BlockBytes);
  block.words.reserve(MostWords);
  block.text.assign(text.begin(), text.end());
  this->Offset += text.size();
  this->Blocks.submit();
  return true;
}

void WordsAhead::findWords(TextBlock& block, const CharacterKinds& kinds)
{
  block.words.clear();
  const char* const begin = block.text.data();
  const char* const end = begin + block.text.size();
  std::uint32_t line = 0;
  for (const char* at = begin; at < end && block.words.size() < MostWords;)
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
        at = std::find(at, end, '\n');
        break;
      case CharacterKinds::LineEnd:
        ++line;
        [[fallthrough]];
      case CharacterKinds::Blank:
        ++at;
    }
  }
}

} // namespace smg
