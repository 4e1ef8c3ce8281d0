// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Vtk/LegacyVtkScanner.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/LineEnds.h"
#include "IO/Files/TextNumbers.h"
#include "IO/Mesh/Format.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace smg
{

namespace
{

/** The maximum length of words and lines of keywords and names. */

struct TypeName
{
  std::string_view name;
  ScalarType file, column;
};

/** The first name of a type is the one that is written. Numbers of type vtkIdType are written as
 * int. */
constexpr TypeName LegacyTypeNames[] = { { "char", ScalarType::Int8, ScalarType::Int8 },
  { "signed_char", ScalarType::Int8, ScalarType::Int8 },
  { "unsigned_char", ScalarType::UInt8, ScalarType::UInt8 },
  { "short", ScalarType::Int16, ScalarType::Int16 },
  { "unsigned_short", ScalarType::UInt16, ScalarType::UInt16 },
  { "int", ScalarType::Int32, ScalarType::Int32 },
  { "unsigned_int", ScalarType::UInt32, ScalarType::UInt32 },
  { "vtkidtype", ScalarType::Int32, ScalarType::Int64 },
  { "float", ScalarType::Float32, ScalarType::Float32 },
  { "double", ScalarType::Float64, ScalarType::Float64 },
  { "vtktypeint8", ScalarType::Int8, ScalarType::Int8 },
  { "vtktypeuint8", ScalarType::UInt8, ScalarType::UInt8 },
  { "vtktypeint16", ScalarType::Int16, ScalarType::Int16 },
  { "vtktypeuint16", ScalarType::UInt16, ScalarType::UInt16 },
  { "vtktypeint32", ScalarType::Int32, ScalarType::Int32 },
  { "vtktypeuint32", ScalarType::UInt32, ScalarType::UInt32 },
  { "vtktypeint64", ScalarType::Int64, ScalarType::Int64 },
  { "vtktypeuint64", ScalarType::UInt64, ScalarType::UInt64 },
  { "long", ScalarType::Int64, ScalarType::Int64 },
  { "unsigned_long", ScalarType::UInt64, ScalarType::UInt64 },
  { "vtktypefloat32", ScalarType::Float32, ScalarType::Float32 },
  { "vtktypefloat64", ScalarType::Float64, ScalarType::Float64 } };

char lower(char c)
{
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool isSpace(char c)
{
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

std::optional<TypeName> typeOf(std::string name)
{
  std::ranges::transform(name, name.begin(), lower);
  const auto* const found = std::ranges::find(LegacyTypeNames, name, &TypeName::name);
  return found == std::end(LegacyTypeNames) ? std::nullopt : std::optional(*found);
}

} // namespace

std::string_view legacyTypeName(ScalarType type)
{
  return std::ranges::find_if(LegacyTypeNames,
    [type](const TypeName& known) { return known.file == type && known.column == type; })
    ->name;
}

void LegacyVtkScanner::readTitle()
{
  constexpr std::string_view Title = "# vtk DataFile Version ";
  this->LineEnd = lineEndOf(this->File.at(0, FormatBytes).substr(0, FormatBytes));
  const std::string first = this->line();
  const auto isDigit = [&first](std::size_t i)
  { return i < first.size() && first[i] >= '0' && first[i] <= '9'; };
  if (!first.starts_with(Title) || !isDigit(Title.size()) || first[Title.size() + 1] != '.' ||
      !isDigit(Title.size() + 2))
  {
    this->File.fail(0, "the first line does not say the version of the format, as '4.2'");
  }
  this->Version = first[Title.size()] - '0';
  this->line();
  const std::string mode = this->keyword();
  if (mode != "ASCII" && mode != "BINARY")
  {
    this->fail("the third line should be ASCII or BINARY, it is " + inQuotes(mode));
  }
  this->Binary = mode == "BINARY";
}

void LegacyVtkScanner::skipBlanks()
{
  for (;;)
  {
    const std::string_view text = this->File.at(this->At);
    const auto* const word = std::find_if_not(text.begin(), text.end(), isSpace);
    this->At += static_cast<std::size_t>(word - text.begin());
    if (word != text.end() || text.empty())
    {
      return;
    }
  }
}

std::string LegacyVtkScanner::peek()
{
  this->skipBlanks();
  const std::string_view text = this->File.at(this->At, MaxLineBytes).substr(0, MaxLineBytes);
  const auto* const end = std::find_if(text.begin(), text.end(), isSpace);
  return { text.begin(), end };
}

std::string LegacyVtkScanner::word()
{
  std::string word = this->peek();
  this->At += word.size();
  return word;
}

std::string LegacyVtkScanner::keyword()
{
  std::string word = this->word();
  std::ranges::transform(word, word.begin(),
    [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  return word;
}

namespace
{

/** A name or text in which % and two hexadecimal digits encode a character. */
std::string decodedVtkName(const std::string& name)
{
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    int code = 0;
    const char* const digits = name.data() + i + 1;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
    {
      text += static_cast<char>(code);
      i += 2;
    }
    else
    {
      text += name[i];
    }
  }
  return text;
}

} // namespace

std::string LegacyVtkScanner::name()
{
  return decodedVtkName(this->word());
}

std::string LegacyVtkScanner::line(std::size_t most)
{
  std::string line;
  for (;;)
  {
    const std::string_view text = this->File.at(this->At);
    const std::size_t end = text.find(this->LineEnd);
    const std::string_view part = text.substr(0, end);
    line += part.substr(0, most - std::min(most, line.size()));
    this->At += part.size();
    if (end != std::string_view::npos)
    {
      ++this->At;
      return line;
    }
    if (text.empty())
    {
      return line;
    }
  }
}

std::int64_t LegacyVtkScanner::count(const char* what)
{
  const std::string word = this->word();
  std::int64_t value = -1;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size() || value < 0)
  {
    this->fail(word.empty() ? std::string("the file ends where ") + what + " should be"
                            : inQuotes(word) + " cannot be " + what);
  }
  return value;
}

VtkArray LegacyVtkScanner::array(
  const std::string& name, const std::string& type, int components, std::int64_t values)
{
  const auto known = typeOf(type);
  if (!known)
  {
    this->fail(inQuotes(type) + " is not a type of numbers that is read");
  }
  VtkArray array;
  array.name = name;
  array.columnType = known->column;
  array.type = this->Binary ? known->file : known->column;
  array.components = components;
  array.values = values;
  array.byteOrder = this->Binary ? std::endian::big : std::endian::little;
  array.encoding = this->Binary ? VtkEncoding::Raw : VtkEncoding::Text;
  if (this->Binary)
  {
    this->line();
    array.begin = this->At;
    this->skipBytes(values, sizeOf(array.type));
    return array;
  }
  array.begin = this->At;
  TextNumbers text(this->File, this->At);
  const std::int64_t found = text.skip(values);
  this->At = text.offset();
  if (found < values)
  {
    this->fail("the array " + inQuotes(name) + " has " + std::to_string(found) + " numbers, not " +
               std::to_string(values) + ": the file is truncated or the count is wrong");
  }
  return array;
}

void LegacyVtkScanner::skipBytes(std::int64_t count, std::size_t size)
{
  const std::size_t left = this->File.size() - std::min(this->At, this->File.size());
  if (static_cast<std::uint64_t>(count) > left / size)
  {
    this->fail(std::to_string(count) + " numbers of " + std::to_string(size) +
               " bytes should be here, but the file has " + std::to_string(left) +
               " more bytes: it is truncated or the count is wrong");
  }
  this->At += static_cast<std::size_t>(count) * size;
}

void LegacyVtkScanner::skipBits(std::int64_t bits)
{
  if (this->Binary)
  {
    this->line();
    this->skipBytes(bits / 8 + (bits % 8 != 0), 1);
    return;
  }
  this->array("bits", "unsigned_char", 1, bits);
}

std::string LegacyVtkScanner::skipTexts(std::int64_t texts, std::size_t most)
{
  constexpr std::size_t MostEncoded = 3; // characters of a byte
  std::string last;
  this->line();
  for (std::int64_t i = 0; i < texts; ++i)
  {
    const std::string_view text = this->File.at(this->At, 8);
    if (text.empty())
    {
      this->fail("the file ends within an array of texts");
    }
    if (!this->Binary)
    {
      last = decodedVtkName(this->line(MostEncoded * most));
      continue;
    }
    // The two highest bits encode the number of bytes of the length: 8, 4, 2 or 1.
    const int bytes = 8 >> (static_cast<unsigned char>(text[0]) >> 6);
    std::uint64_t length = static_cast<unsigned char>(text[0]) & 0x3f;
    for (int k = 1; k < bytes && k < static_cast<int>(text.size()); ++k)
    {
      length = length << 8 | static_cast<unsigned char>(text[static_cast<std::size_t>(k)]);
    }
    this->skipBytes(bytes, 1);
    const std::size_t begin = this->At;
    this->skipBytes(static_cast<std::int64_t>(length), 1);
    last.clear();
    for (const std::size_t end = std::min<std::uint64_t>(length, most); last.size() < end;)
    {
      last += this->File.at(begin + last.size()).substr(0, end - last.size());
    }
  }
  return last;
}

} // namespace smg
