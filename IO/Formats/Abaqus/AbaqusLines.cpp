// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Abaqus/AbaqusLines.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/FortranNumbers.h"

#include <algorithm>
#include <cctype>

namespace smg
{
namespace
{

std::string_view withoutBlanks(std::string_view text)
{
  text = trimmed(text);
  return text.substr(0, text.find_last_not_of(Blanks) + 1);
}

} // namespace

std::string upperCase(std::string_view text)
{
  std::string upper(text);
  std::ranges::transform(
    upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

std::string AbaqusKeyword::value(const std::string& parameter) const
{
  const auto found = this->parameters.find(parameter);
  return found == this->parameters.end() ? std::string() : found->second;
}

/** Reads the next line that has content, without consuming it; false at the end. */
bool AbaqusLines::peekLine()
{
  while (this->Scanner.left() > 0)
  {
    const std::optional<std::string_view> text = this->Scanner.restOfLine();
    if (!text)
    {
      this->Scanner.fail("the line is longer than " + std::to_string(TextScanner::MaxTokenBytes) +
                         " bytes, which is too long");
    }
    const std::string_view line = withoutBlanks(*text);
    if (!line.empty() && !line.starts_with("**"))
    {
      this->Line = line;
      this->LineNumber = this->Scanner.line();
      return true;
    }
    this->Scanner.skipLine();
  }
  return false;
}

bool AbaqusLines::next(AbaqusKeyword& keyword)
{
  while (this->peekLine() && this->Line[0] != '*')
  {
    this->Scanner.skipLine();
  }
  if (this->Scanner.left() == 0)
  {
    return false;
  }
  std::string text = this->Line.substr(1);
  this->Scanner.skipLine();
  while (text.ends_with(',') && text.size() < TextScanner::MaxTokenBytes && this->peekLine() &&
         this->Line[0] != '*')
  {
    text += this->Line;
    this->Scanner.skipLine();
  }
  keyword = {};
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = withoutBlanks(std::string_view(text).substr(begin, end - begin));
    const std::size_t sign = std::min(part.find('='), part.size());
    const std::string name = upperCase(withoutBlanks(part.substr(0, sign)));
    std::string_view value = withoutBlanks(part.substr(std::min(sign + 1, part.size())));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
    {
      value = value.substr(1, value.size() - 2);
    }
    if (begin == 0)
    {
      keyword.name = name;
    }
    else if (!name.empty())
    {
      keyword.parameters.emplace(name, value);
    }
    begin = end + 1;
  }
  return true;
}

bool AbaqusLines::nextData()
{
  if (!this->peekLine() || this->Line[0] == '*')
  {
    return false;
  }
  this->Scanner.skipLine();
  this->At = 0;
  return true;
}

std::optional<std::string_view> AbaqusLines::field()
{
  if (this->At >= this->Line.size())
  {
    return {};
  }
  const std::size_t end = std::min(this->Line.find(',', this->At), this->Line.size());
  const std::string_view text = std::string_view(this->Line).substr(this->At, end - this->At);
  this->At = end + 1;
  return withoutBlanks(text);
}

std::int64_t AbaqusLines::integer(const char* what)
{
  const std::string_view text = this->field().value_or("");
  const std::optional<std::int64_t> number = parseInteger(text);
  if (!number)
  {
    throw MeshError(
      inQuotes(text) + " stands where " + what + " should be, an integer", this->LineNumber);
  }
  return *number;
}

double AbaqusLines::real(const char* what)
{
  const std::string_view text = this->field().value_or("");
  if (text.empty())
  {
    return 0.0;
  }
  const std::optional<double> number = parseFortran(text);
  if (!number)
  {
    throw MeshError(
      inQuotes(text) + " stands where " + what + " should be, a finite number", this->LineNumber);
  }
  return *number;
}

std::int64_t AbaqusLines::integerInLines(const char* what)
{
  if (this->At >= this->Line.size() && !this->nextData())
  {
    throw MeshError(std::string("the lines end where ") + what + " should be", this->LineNumber);
  }
  return this->integer(what);
}

} // namespace smg
