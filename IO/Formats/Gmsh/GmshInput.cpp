// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/GmshInput.h"

#include <array>
#include <optional>
#include <string_view>

namespace smg
{

void GmshInput::readFormat()
{
  if (this->hasFormat())
  {
    this->fail("there are two sections $MeshFormat");
  }
  const double version = this->Scanner.number("the version");
  if (version != 4.0 && version != 4.1 && (version < 2.0 || version >= 3.0))
  {
    this->fail("this version of the format is not read: save the mesh as 2.2 or 4.1");
  }
  const std::int64_t kind = this->Scanner.integer("the kind of file");
  if (kind != 0 && kind != 1)
  {
    this->fail("the kind of file must be 0 (text) or 1 (binary), not " + std::to_string(kind));
  }
  const std::int64_t size = this->Scanner.integer("the size of a number");
  if (kind == 1)
  {
    if (size != 8)
    {
      this->fail("numbers of " + std::to_string(size) + " bytes are not read, only of 8");
    }
    this->Binary = true;
    this->beginNumbers();
    const auto one = this->Numbers.take<std::uint32_t>("the number one");
    const bool isOther = one == 0x01000000U;
    this->Numbers.setByteOrder(isOther ? OtherByteOrder : std::endian::native);
    if (one != 1 && !isOther)
    {
      this->fail("the byte order is not known: the number one should be here");
    }
    this->endNumbers();
  }
  this->Version = version >= 4.0 ? 4 : 2;
  this->IsFourZero = version == 4.0;
}

std::string GmshInput::sectionName()
{
  if (this->Scanner.atEnd())
  {
    return {};
  }
  std::string name(this->Scanner.token());
  if (name[0] != '$' || name.size() == 1)
  {
    this->fail(inQuotes(name) + " stands where a section should begin");
  }
  return name;
}

void GmshInput::endSection(const std::string& end)
{
  const std::string_view token = this->Scanner.token();
  if (token.empty())
  {
    this->fail("the file is truncated: " + inQuotes(end) + " is missing");
  }
  if (token != end)
  {
    this->fail(inQuotes(token) + " stands where " + inQuotes(end) +
               " should be: the section is longer than its numbers of entries say");
  }
}

void GmshInput::skipSection(const std::string& end)
{
  if (!this->Binary)
  {
    while (this->Scanner.peek() != end)
    {
      if (this->Scanner.atEnd())
      {
        this->fail("the file is truncated: " + inQuotes(end) + " is missing");
      }
      this->Scanner.skipLine();
    }
    this->Scanner.token();
    return;
  }
  for (std::size_t offset = this->Scanner.offset();;)
  {
    const std::string_view bytes = this->File.at(offset, end.size());
    const std::size_t place = bytes.find(end);
    if (place != std::string_view::npos)
    {
      this->Scanner.moveTo(offset + place + end.size());
      return;
    }
    if (offset + bytes.size() >= this->File.size())
    {
      this->File.fail(this->File.size(), "the file is truncated: " + inQuotes(end) + " is missing");
    }
    offset += bytes.size() - (end.size() - 1);
  }
}

std::int64_t GmshInput::lineCount(const char* what, std::size_t minText, std::size_t minBinary)
{
  if (!this->Binary)
  {
    return this->Scanner.count(what, minText);
  }
  const std::string_view token = this->Scanner.token();
  const std::optional<std::int64_t> count = parseInteger(token);
  if (!count)
  {
    this->fail(inQuotes(token) + " is not an integer, where " + what + " should be");
  }
  this->requireRoom(*count, what, minBinary);
  return *count;
}

GmshInput::PhysicalName GmshInput::physicalName()
{
  const std::int64_t dimension = this->Scanner.integer("the dimension of a physical group");
  const std::int64_t group = this->Scanner.integer("the tag of a physical group");
  const std::string_view rest = this->Scanner.restOfLine().value_or("");
  const std::size_t begin = rest.find('"'), end = rest.rfind('"');
  if (dimension < 0 || dimension > 3 || begin == std::string_view::npos || begin == end)
  {
    this->fail("a physical name must be a dimension, 0 to 3, a tag, and a name in quotation marks");
  }
  PhysicalName named{ static_cast<int>(dimension), group,
    std::string(rest.substr(begin + 1, end - begin - 1)) };
  this->Scanner.skipLine();
  return named;
}

GmshInput::DataHeader GmshInput::dataHeader()
{
  constexpr std::int64_t MostTags = 1000, MostComponents = 1000;
  const auto tags = [this](const char* what)
  {
    const std::int64_t count = this->Scanner.count(what, 2);
    if (count > MostTags)
    {
      this->fail(std::to_string(count) + " cannot be " + what);
    }
    return count;
  };
  DataHeader header;
  const std::int64_t texts = tags("the number of texts of the data");
  this->Scanner.skipLine();
  for (std::int64_t i = 0; i < texts; ++i)
  {
    const std::string_view line = this->Scanner.restOfLine().value_or("");
    const std::size_t begin = line.find('"'), end = line.rfind('"');
    if (begin == std::string_view::npos || begin == end)
    {
      this->fail("the name of the data must be in quotation marks");
    }
    if (i == 0)
    {
      header.name = line.substr(begin + 1, end - begin - 1);
    }
    this->Scanner.skipLine();
  }
  const std::int64_t reals = tags("the number of real tags of the data");
  for (std::int64_t i = 0; i < reals; ++i)
  {
    this->Scanner.number("a real tag of the data");
  }
  const std::int64_t integers = tags("the number of integer tags of the data");
  std::array<std::int64_t, 3> first{};
  for (std::int64_t i = 0; i < integers; ++i)
  {
    const std::int64_t tag = this->Scanner.integer("an integer tag of the data");
    if (i < std::ssize(first))
    {
      first[static_cast<std::size_t>(i)] = tag;
    }
  }
  header.step = first[0];
  header.components = first[1];
  header.entries = first[2];
  if (integers < std::ssize(first) || header.components < 1 || header.components > MostComponents)
  {
    this->fail("data begin with their time step, their number of components, from 1 to " +
               std::to_string(MostComponents) + ", and their number of values");
  }
  this->beginNumbers();
  const auto numbers = static_cast<std::size_t>(header.components);
  this->requireRoom(header.entries, "the number of values",
    this->Binary ? sizeof(std::int32_t) + numbers * sizeof(double) : 2 + 2 * numbers);
  return header;
}

void GmshInput::beginNumbers()
{
  if (this->Binary)
  {
    this->Scanner.skipLine();
    this->Numbers.moveTo(this->Scanner.offset());
    this->InNumbers = true;
  }
}

void GmshInput::endNumbers()
{
  if (this->Binary)
  {
    this->Scanner.moveTo(this->Numbers.offset());
    this->InNumbers = false;
  }
}

std::int64_t GmshInput::count(const char* what, std::size_t minText, std::size_t minBinary)
{
  if (!this->Binary)
  {
    return this->Scanner.count(what, minText);
  }
  const auto count = this->Numbers.take<std::int64_t>(what);
  this->requireRoom(count, what, minBinary);
  return count;
}

void GmshInput::fail(const std::string& sentence) const
{
  if (this->Binary)
  {
    this->File.fail(this->InNumbers ? this->Numbers.offset() : this->Scanner.offset(), sentence);
  }
  this->Scanner.fail(sentence);
}

} // namespace smg
