// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Ply/PlyHeader.h"

#include "IO/Files/TextScanner.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

namespace smg
{
namespace
{

/** The type of a name such as uchar or uint8; PLY has none of 64-bit integers. */
std::optional<ScalarType> scalarType(std::string_view name)
{
  for (int i = 0; i <= static_cast<int>(ScalarType::Float64); ++i)
  {
    const auto type = static_cast<ScalarType>(i);
    const std::string_view own = plyTypeName(type);
    if (!own.empty() && (name == own || name == nameOf(type)))
    {
      return type;
    }
  }
  return std::nullopt;
}

ScalarType typeToken(TextScanner& scanner)
{
  const std::string_view token = scanner.tokenInLine();
  const std::optional<ScalarType> type = scalarType(token);
  if (!type)
  {
    scanner.fail(inQuotes(token) + " is not a PLY type");
  }
  return *type;
}

PlyEncoding readEncoding(TextScanner& scanner)
{
  const std::string_view format = scanner.tokenInLine();
  if (format == "ascii")
  {
    return PlyEncoding::Ascii;
  }
  if (format == "binary_little_endian")
  {
    return PlyEncoding::LittleEndian;
  }
  if (format == "binary_big_endian")
  {
    return PlyEncoding::BigEndian;
  }
  scanner.fail(inQuotes(format) + " is not a PLY format: it must be ascii, binary_little_endian or "
                                  "binary_big_endian");
}

PlyElement readElement(TextScanner& scanner)
{
  PlyElement element;
  element.name = scanner.tokenInLine();
  element.count = scanner.toInteger(scanner.tokenInLine(), "the number of records of an element");
  if (element.count < 0)
  {
    scanner.fail("an element has a negative number of records");
  }
  return element;
}

PlyProperty readProperty(TextScanner& scanner, const std::vector<PlyElement>& elements)
{
  if (elements.empty())
  {
    scanner.fail("a property comes before the first element");
  }
  PlyProperty property;
  std::string_view token = scanner.tokenInLine();
  if (token == "list")
  {
    property.list = true;
    property.lengthType = typeToken(scanner);
    if (property.lengthType >= ScalarType::Float32)
    {
      scanner.fail("the length of a list must be an integer");
    }
    property.type = typeToken(scanner);
  }
  else if (const std::optional<ScalarType> type = scalarType(token))
  {
    property.type = *type;
  }
  else
  {
    scanner.fail(inQuotes(token) + " is not a PLY type");
  }
  property.name = scanner.tokenInLine();
  const std::vector<PlyProperty>& others = elements.back().properties;
  const bool again = std::any_of(others.begin(), others.end(),
    [&property](const PlyProperty& other) { return other.name == property.name; });
  if (property.name.empty() || again)
  {
    scanner.fail(again ? "the property " + inQuotes(property.name) + " comes twice"
                       : std::string("a property has no name"));
  }
  return property;
}

/** Whether it is a keyword except for the case of its letters. */
bool isMisspelt(std::string_view word)
{
  constexpr std::string_view keywords[] = { "ply", "format", "element", "property", "end_header" };
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::ranges::any_of(
    keywords, [&](std::string_view keyword) { return std::ranges::equal(word, keyword, same); });
}

/** Reads the lines after the first one. */
PlyHeader readLines(TextScanner& scanner)
{
  PlyHeader header;
  // A header is held in memory, with its comments where the file is written anew.
  constexpr int MaxLines = 4096;
  constexpr std::size_t MaxBytes = std::size_t(1) << 20;
  int lines = 0;
  bool formatKnown = false;
  // An unknown line; with properties it is a misspelt element.
  std::int64_t unknownLine = 0;
  std::string unknownKeyword;
  while (true)
  {
    scanner.skipLine();
    const std::string_view keyword = scanner.tokenInLine();
    if (scanner.offset() > MaxBytes)
    {
      scanner.fail(
        "the header has more than 1 MiB, which is more than is read: remove its comments");
    }
    if (keyword == "end_header")
    {
      break;
    }
    if ((keyword == "element" || keyword == "property") && ++lines > MaxLines)
    {
      scanner.fail(
        "the header has more than " + std::to_string(MaxLines) + " elements and properties");
    }
    if (keyword == "format")
    {
      header.encoding = readEncoding(scanner);
      formatKnown = true;
    }
    else if (keyword == "element")
    {
      header.elements.push_back(readElement(scanner));
      unknownLine = 0;
    }
    else if (keyword == "property")
    {
      if (unknownLine > 0)
      {
        scanner.failAt(unknownLine, inQuotes(unknownKeyword) + " is not a keyword of a PLY header");
      }
      PlyProperty property = readProperty(scanner, header.elements);
      header.elements.back().properties.push_back(std::move(property));
    }
    else if (scanner.left() == 0)
    {
      scanner.fail("the file ends in its header");
    }
    else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info")
    {
      if (isMisspelt(keyword))
      {
        scanner.fail(inQuotes(keyword) + " is not a keyword of a PLY header");
      }
      constexpr std::size_t KeptBytes = 80, KeptKeywords = 10;
      unknownKeyword = keyword.substr(0, KeptBytes);
      if (header.unknown.size() < KeptKeywords &&
          std::ranges::find(header.unknown, unknownKeyword) == header.unknown.end())
      {
        header.unknown.push_back(unknownKeyword);
      }
      unknownLine = scanner.line();
    }
  }
  if (!formatKnown)
  {
    scanner.fail("the header has no format line");
  }
  scanner.skipLine();
  header.bodyOffset = scanner.offset();
  header.bodyLine = scanner.line();
  return header;
}

/** The column of a property, and its component in it. */
std::pair<ColumnSpec, int> columnOf(const PlyElement& element, const PlyProperty& property)
{
  struct Group
  {
    const char* column;
    int least; // components
    std::array<const char*, 4> names;
  };
  constexpr Group groups[] = { { NormalsName, 3, { "nx", "ny", "nz", "" } },
    { TextureCoordinatesName, 2, { "texture_u", "texture_v", "", "" } },
    { ColorsName, 3, { "red", "green", "blue", "alpha" } } };
  for (const Group& candidate : groups)
  {
    int components = 0;
    int component = -1;
    for (const char* name : candidate.names)
    {
      const PlyProperty* member = findNumber(element, name);
      if (!member || member->type != property.type)
      {
        break;
      }
      component = member == &property ? components : component;
      ++components;
    }
    if (component >= 0 && components >= candidate.least)
    {
      return { { candidate.column, property.type, components }, component };
    }
  }
  return { { property.name, property.type, 1 }, 0 };
}

/** Makes the columns of an element, each at its first component. */
class ColumnMaker
{
public:
  ColumnMaker(PlyPlan& plan, const std::function<int(const ColumnSpec&)>& add)
    : Plan(plan)
    , Add(add)
  {
  }

  /** The step of a component of a column. */
  PlyStep step(const ColumnSpec& spec, int component)
  {
    auto known = std::ranges::find(this->Columns, spec, &Known::spec);
    if (known == this->Columns.end())
    {
      known = this->Columns.insert(known, { spec, this->Plan.attributeBytes, this->Add(spec) });
      if (known->number >= 0)
      {
        this->Plan.tuples.push_back(
          { known->number, this->Plan.attributeBytes, spec.tupleBytes() });
        this->Plan.attributeBytes += spec.tupleBytes();
      }
    }
    PlyStep step;
    step.type = spec.type;
    step.kind = known->number >= 0 ? PlyStep::Attribute : PlyStep::Skip;
    step.place = known->begin + sizeOf(spec.type) * static_cast<std::size_t>(component);
    return step;
  }

private:
  struct Known
  {
    ColumnSpec spec;
    std::size_t begin; ///< in the record's attributes
    int number;
  };

  PlyPlan& Plan;
  const std::function<int(const ColumnSpec&)>& Add;
  std::vector<Known> Columns;
};

bool isAxis(const PlyProperty& property)
{
  return property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
}

PlyStep stepOfList(const PlyProperty& property, bool mayBeCorners)
{
  const bool corners =
    mayBeCorners && (property.name == "vertex_indices" || property.name == "vertex_index");
  PlyStep step;
  step.kind = corners ? PlyStep::Corners : PlyStep::SkipList;
  step.type = property.type;
  step.lengthType = property.lengthType;
  return step;
}

} // namespace

std::size_t PlyElement::minBytes(bool ascii) const
{
  std::size_t bytes = 0;
  for (const PlyProperty& property : this->properties)
  {
    // A number in text and the blank or line end after it.
    bytes += ascii ? 2 : sizeOf(property.list ? property.lengthType : property.type);
  }
  return bytes;
}

PlyHeader readPlyHeader(InputFile& file)
{
  TextScanner scanner(file);
  if (scanner.tokenInLine() != "ply")
  {
    scanner.fail("a PLY file must begin with the line 'ply'");
  }
  try
  {
    return readLines(scanner);
  }
  catch (const Error&)
  {
    // An error in the last line of the file means that the file is cut.
    if (scanner.left() > 0)
    {
      throw;
    }
    scanner.fail("the file ends in its header");
  }
}

const PlyProperty* findNumber(const PlyElement& element, std::string_view name)
{
  const auto found = std::ranges::find_if(element.properties,
    [name](const PlyProperty& property) { return property.name == name && !property.list; });
  return found == element.properties.end() ? nullptr : &*found;
}

std::vector<std::string> leftOutOf(const PlyHeader& header)
{
  std::vector<std::string> found;
  for (const PlyElement& element : header.elements)
  {
    const bool isOfCells = element.name == "face" || element.name == "tristrips";
    if (element.count > 0 && !isOfCells && element.name != "vertex")
    {
      found.push_back("the element " + inQuotes(element.name));
      continue;
    }
    bool mayBeCorners = isOfCells;
    for (const PlyProperty& property : element.properties)
    {
      if (!property.list || element.count == 0)
      {
        continue;
      }
      if (stepOfList(property, mayBeCorners).kind == PlyStep::Corners)
      {
        mayBeCorners = false;
        continue;
      }
      found.push_back(
        "the list " + inQuotes(property.name) + " of the element " + inQuotes(element.name));
    }
  }
  return found;
}

PlyPlan planOf(
  const PlyElement& element, PlyRole role, const std::function<int(const ColumnSpec&)>& addColumn)
{
  PlyPlan plan;
  ColumnMaker columns(plan, addColumn);
  bool hasCorners = false;
  for (const PlyProperty& property : element.properties)
  {
    PlyStep step;
    step.type = property.type;
    if (property.list)
    {
      step = stepOfList(property, role == PlyRole::Cells && !hasCorners);
      hasCorners |= step.kind == PlyStep::Corners;
    }
    else if (role == PlyRole::Vertices && isAxis(property))
    {
      step.kind = PlyStep::Coordinate;
      step.place = static_cast<std::size_t>(property.name[0] - 'x');
    }
    else if (role != PlyRole::Others && addColumn)
    {
      const auto [spec, component] = columnOf(element, property);
      step = columns.step(spec, component);
    }
    const bool more = !plan.steps.empty() && step.kind == PlyStep::Skip &&
                      plan.steps.back().kind == PlyStep::Skip &&
                      plan.steps.back().type == step.type;
    more ? void(++plan.steps.back().count) : plan.steps.push_back(step);
  }
  return plan;
}

} // namespace smg
