// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Nastran/NastranCards.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/FortranNumbers.h"

#include <algorithm>
#include <cctype>

namespace smg
{
namespace
{

constexpr std::size_t NameWidth = 8, FieldsWidth = 64;

std::string_view trimmedField(std::string_view text)
{
  text = trimmed(text);
  return text.substr(0, text.find_last_not_of(Blanks) + 1);
}

/** With blanks up to the next column of eight for each tabulator. */
std::string withoutTabs(std::string_view text)
{
  std::string line;
  for (const char c : text)
  {
    line += c == '\t' ? std::string(NameWidth - line.size() % NameWidth, ' ') : std::string(1, c);
  }
  return line;
}

} // namespace

/** Reads the next line that has content, without consuming it; false at the end. */
bool NastranCards::peekLine()
{
  while (this->Scanner.left() > 0)
  {
    const std::optional<std::string_view> text = this->Scanner.restOfLine();
    if (!text)
    {
      this->Scanner.fail("the line is longer than " + std::to_string(TextScanner::MaxTokenBytes) +
                         " bytes, which is too long");
    }
    std::string_view line = text->substr(0, text->find('$'));
    line = line.substr(0, line.find_last_not_of(Blanks) + 1);
    if (!line.empty())
    {
      this->Line = withoutTabs(line);
      return true;
    }
    this->Scanner.skipLine();
  }
  return false;
}

/** Takes the fields of the line. */
void NastranCards::addFields(bool isFirst)
{
  const std::string_view line = this->Line;
  const std::size_t comma = line.find(',');
  const std::string_view first =
    line.substr(0, comma == std::string_view::npos ? NameWidth : comma);
  const bool isLarge = first.find('*') != std::string_view::npos;
  const std::size_t fields = isLarge ? 4 : 8;
  if (isFirst)
  {
    this->Name.clear();
    for (const char c : trimmedField(first))
    {
      if (c != '*')
      {
        this->Name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      }
    }
  }
  if (comma != std::string_view::npos)
  {
    std::size_t begin = comma + 1;
    for (std::size_t i = 0; i < fields; ++i)
    {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      this->Fields.emplace_back(
        trimmedField(line.substr(std::min(begin, line.size()), end - std::min(begin, end))));
      begin = end + 1;
    }
    return;
  }
  const std::size_t width = FieldsWidth / fields;
  for (std::size_t i = 0; i < fields; ++i)
  {
    const std::size_t begin = std::min(NameWidth + i * width, line.size());
    this->Fields.emplace_back(trimmedField(line.substr(begin, width)));
  }
}

bool NastranCards::next()
{
  if (!this->peekLine())
  {
    return false;
  }
  constexpr std::size_t MostFields = 100000; // of a set that does not end
  this->Fields.clear();
  this->LineNumber = this->Scanner.line();
  this->addFields(true);
  this->Scanner.skipLine();
  const auto continues = [](char c) { return c == '+' || c == '*' || c == ' ' || c == ','; };
  while (this->peekLine() && continues(this->Line[0]) && this->Fields.size() < MostFields)
  {
    this->addFields(false);
    this->Scanner.skipLine();
  }
  return true;
}

std::optional<std::int64_t> NastranCards::integer(std::size_t i, const char* what) const
{
  const std::string_view text = this->field(i);
  const std::optional<std::int64_t> number = parseInteger(text);
  if (!number && !text.empty())
  {
    throw MeshError(
      inQuotes(text) + " stands where " + what + " should be, an integer", this->LineNumber);
  }
  return number;
}

std::optional<double> NastranCards::real(std::size_t i, const char* what) const
{
  const std::string_view text = this->field(i);
  const std::optional<double> number = parseFortran(text);
  if (!number && !text.empty())
  {
    throw MeshError(
      inQuotes(text) + " stands where " + what + " should be, a finite number", this->LineNumber);
  }
  return number;
}

std::int64_t NastranCards::requiredInteger(std::size_t i, const char* what) const
{
  const std::optional<std::int64_t> number = this->integer(i, what);
  if (!number)
  {
    throw MeshError("the field " + std::to_string(i + 2) + " of " + this->Name +
                      " is empty, where " + what + " should be",
      this->LineNumber);
  }
  return *number;
}

} // namespace smg
