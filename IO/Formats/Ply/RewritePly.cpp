// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/LineEnds.h"
#include "IO/Files/SequentialOutput.h"
#include "IO/Formats/Ply/PlyCursor.h"
#include "IO/Formats/Ply/PlyFormat.h"
#include "IO/Formats/Ply/PlyHeader.h"
#include "IO/Mesh/Columns.h"
#include "IO/Results/MovedVertices.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

namespace
{

/** The treatment of a property. */
struct Fate
{
  enum Kind
  {
    Keep,
    Drop,
    Position,
    Normal
  };
  Kind kind = Keep;
  int axis = 0;
  ScalarType type = ScalarType::Float32; ///< of the property in the new file
};

/** 0, 1, 2 for x, y, z and for nx, ny, nz; -1 for other names. */
int axisOf(std::string_view name, std::string_view prefix)
{
  const bool isOne = name.size() == prefix.size() + 1 && name.starts_with(prefix) &&
                     name.back() >= 'x' && name.back() <= 'z';
  return isOne ? name.back() - 'x' : -1;
}

/** Moved coordinates and computed normals are not integers. */
ScalarType movedPositionType(ScalarType type)
{
  const bool isLong = type == ScalarType::Int32 || type == ScalarType::UInt32;
  return isLong ? ScalarType::Float64 : std::max(type, ScalarType::Float32);
}
ScalarType normalType(ScalarType type)
{
  return std::max(type, ScalarType::Float32);
}

std::vector<Fate> fatesOf(const PlyElement& element, bool hasNormals)
{
  const bool isVertex = element.name == "vertex";
  std::vector<Fate> fates;
  for (const PlyProperty& property : element.properties)
  {
    Fate fate{ Fate::Keep, 0, property.type };
    const int axis = property.list ? -1 : axisOf(property.name, "");
    const int normal = property.list ? -1 : axisOf(property.name, "n");
    if (isVertex && axis >= 0)
    {
      fate = { Fate::Position, axis, movedPositionType(property.type) };
    }
    else if (normal >= 0 && (isVertex || element.name == "face"))
    {
      fate = { isVertex && hasNormals ? Fate::Normal : Fate::Drop, normal,
        normalType(property.type) };
    }
    fates.push_back(fate);
  }
  return fates;
}

/** The lines of the old header, in the format of the new file and without dropped properties. */
std::string newHeader(std::string_view text, const PlyHeader& header,
  const std::vector<std::vector<Fate>>& fates, bool asText)
{
  std::string result = plyFormatLines(asText);
  int element = -1;
  std::size_t property = 0;
  const char lineEnd = lineEndOf(text);
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find(lineEnd, begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    constexpr std::string_view blanks = " \t\r\f\v";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line = line.substr(0, line.find_last_not_of(blanks) + 1);
    const std::string_view keyword = line.substr(0, line.find_first_of(blanks));
    if (keyword.empty() || keyword == "ply" || keyword == "format")
    {
      continue;
    }
    if (keyword == "element")
    {
      ++element;
      property = 0;
    }
    if (keyword == "property")
    {
      const auto e = static_cast<std::size_t>(element);
      const PlyProperty& old = header.elements[e].properties[property];
      const Fate& fate = fates[e][property++];
      if (fate.kind == Fate::Drop)
      {
        continue;
      }
      if (fate.type != old.type)
      {
        result += "property " + std::string(plyTypeName(fate.type)) + ' ' + old.name + '\n';
        continue;
      }
    }
    result += std::string(line) + '\n';
  }
  return result;
}

/** Copies the body of a PLY file. */
template <class Cursor>
class BodyCopier
{
public:
  BodyCopier(Cursor& cursor, MovedVertices& moved, SequentialOutput& out, bool text)
    : In(cursor)
    , Moved(moved)
    , Out(out)
    , Text(text)
  {
  }

  void copy(const PlyElement& element, const std::vector<Fate>& fates)
  {
    const bool isVertex = element.name == "vertex";
    for (std::int64_t i = 0; i < element.count && !fates.empty(); ++i)
    {
      this->In.begin(element.name, i);
      this->HasMoved = isVertex && this->Moved.find(i);
      this->Record.clear();
      for (std::size_t k = 0; k < fates.size(); ++k)
      {
        element.properties[k].list ? this->copyList(element.properties[k], fates[k])
                                   : this->copyNumber(element.properties[k], fates[k], i);
      }
      if (this->Text)
      {
        this->Record.push_back(std::byte('\n'));
      }
      this->Out.put(this->Record);
    }
  }

private:
  void copyNumber(const PlyProperty& property, const Fate& fate, std::int64_t vertex)
  {
    double value = this->In.read(property.type);
    if (fate.kind == Fate::Position && this->HasMoved)
    {
      const std::span<const double, 3> position = this->Moved.position();
      if (fate.type == ScalarType::Float32)
      {
        singlePrecision(position, vertex, this->Out.path().string());
      }
      value = position[static_cast<std::size_t>(fate.axis)];
    }
    else if (fate.kind == Fate::Normal && this->HasMoved)
    {
      value = this->Moved.normal()[static_cast<std::size_t>(fate.axis)];
    }
    if (fate.kind != Fate::Drop)
    {
      this->add(value, fate.type);
    }
  }

  void copyList(const PlyProperty& property, const Fate& fate)
  {
    const std::int64_t length = readPlyLength(this->In, property.lengthType, property.type);
    this->add(static_cast<double>(length), property.lengthType);
    for (std::int64_t i = 0; i < length; ++i)
    {
      this->add(this->In.read(property.type), fate.type);
    }
  }

  void add(double value, ScalarType type)
  {
    dispatch(type,
      [this, value]<class T>(T)
      {
        const T number = static_cast<T>(value);
        if (this->Text)
        {
          this->addText(number);
          return;
        }
        const auto bytes = std::as_bytes(std::span(&number, 1));
        this->Record.insert(this->Record.end(), bytes.begin(), bytes.end());
      });
  }

  /** With the blank before it, but at the beginning of a line. */
  template <class T>
  void addText(T number)
  {
    std::array<char, 33> text{ ' ' };
    const char* const end = std::to_chars(text.data() + 1, text.data() + text.size(), number).ptr;
    const char* const begin = text.data() + (this->Record.empty() ? 1 : 0);
    const auto bytes = std::as_bytes(std::span(begin, end));
    this->Record.insert(this->Record.end(), bytes.begin(), bytes.end());
  }

  Cursor& In;
  MovedVertices& Moved;
  SequentialOutput& Out;
  const bool Text;
  bool HasMoved = false; ///< the current vertex
  std::vector<std::byte> Record;
};

} // namespace

void rewritePly(const std::filesystem::path& in, const std::filesystem::path& out,
  MovedVertices& moved, const RewriteOptions& options, const ProgressFunction& progress)
{
  InputFile file(in, progress);
  const PlyHeader header = readPlyHeader(file);
  moved.check(header.vertices(), in.string());
  std::vector<std::vector<Fate>> fates;
  for (const PlyElement& element : header.elements)
  {
    fates.push_back(fatesOf(element, moved.hasNormals()));
  }
  SequentialOutput output(out);
  output.put(newHeader(
    file.at(0, header.bodyOffset).substr(0, header.bodyOffset), header, fates, options.text));
  withPlyBody(file, header, nullptr,
    [&](auto& cursor)
    {
      BodyCopier copier(cursor, moved, output, options.text);
      for (std::size_t e = 0; e < header.elements.size(); ++e)
      {
        copier.copy(header.elements[e], fates[e]);
      }
    });
  if (options.beforeEnd)
  {
    options.beforeEnd();
  }
  output.finish();
}

} // namespace smg
