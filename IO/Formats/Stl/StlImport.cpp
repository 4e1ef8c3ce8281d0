// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/BinaryInput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Stl/StlFormat.h"
#include "IO/Import/CornerWelder.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <map>
#include <string>

namespace smg
{

namespace
{

/** Receives the facets: passes their corners to the welder, and writes the numbers of their corners
 * to a file. T: the type of the coordinates. */
template <class T>
class FacetCollector
{
public:
  explicit FacetCollector(RawMeshBuilder& builder)
    : Builder(builder)
    , Welder(builder)
    , Sizes(builder.workspace())
  {
  }

  void corner(const typename CornerWelder<T>::Point& point)
  {
    this->Welder.corner(point);
    ++this->Size;
  }
  void endFacet()
  {
    this->Sizes.put(this->Size);
    this->Size = 0;
  }

  /** Passes the mesh to the builder. */
  void finish()
  {
    this->Sizes.close();
    this->Welder.makeVertices();
    RecordFile<std::uint32_t>::Reader sizes(this->Sizes);
    for (std::uint32_t size = 0; sizes.next(size);)
    {
      for (std::uint32_t k = 0; k < size; ++k)
      {
        this->Builder.fanCorner(this->Welder.next());
      }
      this->Builder.endTriangles();
    }
  }

private:
  RawMeshBuilder& Builder;
  CornerWelder<T> Welder;
  RecordFile<std::uint32_t> Sizes;
  std::uint32_t Size = 0; ///< corners so far of the current facet
};

/** What follows the facets of a binary file whose size is not that of facets alone. */
struct AttributeBytes
{
  bool any = false;     ///< a facet says that some follow it
  bool endFile = false; ///< with those that the facets say, the file ends after the last one
};

constexpr std::size_t StlNumbersBytes = 12 * sizeof(float); ///< of a triangle: normal and corners

/** Follows the numbers of attribute bytes through the file. */
AttributeBytes findAttributeBytes(InputFile& file, std::uint32_t triangles)
{
  AttributeBytes found;
  BinaryInput input(file, StlHeaderBytes, std::endian::little);
  for (std::uint32_t triangle = 0; triangle < triangles; ++triangle)
  {
    if (input.left() < StlTriangleBytes)
    {
      return found;
    }
    input.skip(StlNumbersBytes);
    const auto bytes = input.take<std::uint16_t>();
    found.any = found.any || bytes > 0;
    if (bytes > input.left())
    {
      return found;
    }
    input.skip(bytes);
  }
  found.endFile = input.left() == 0;
  return found;
}

/** Checks the size of a binary file; returns whether attribute bytes follow each triangle. */
bool checkBinaryLayout(InputFile& file, RawMeshBuilder& builder)
{
  const std::string_view header = file.at(0, StlHeaderBytes);
  if (header.size() < StlHeaderBytes)
  {
    throw Error(file.name() + ": the file is too short for an STL file.");
  }
  const std::uint64_t end = stlBytes(header);
  const std::uint32_t triangles = trianglesOfStl(header);
  if (file.size() < end)
  {
    throw Error(file.name() + ": the file is truncated: " + std::to_string(triangles) +
                " triangles take " + std::to_string(end) + " bytes, it has " +
                std::to_string(file.size()) + '.');
  }
  if (file.size() == end)
  {
    return false;
  }
  // Most programs store a colour as the number of the attribute bytes, of which there are none.
  const AttributeBytes attributes = findAttributeBytes(file, triangles);
  if (attributes.any && attributes.endFile)
  {
    builder.note("The attribute bytes after the triangles are left out.");
    return true;
  }
  if (file.size() - end >= StlTriangleBytes)
  {
    file.fail(end, "there is more after the last of " + std::to_string(triangles) +
                     " triangles: their number at the beginning is wrong");
  }
  if (attributes.any)
  {
    file.fail(end, "there is more after the last of " + std::to_string(triangles) +
                     " triangles, and it is not the attribute bytes that the triangles announce: "
                     "the file is damaged, export it again");
  }
  builder.note("The bytes after the last triangle that the header promises are left out.");
  return false;
}

void readBinary(InputFile& file, RawMeshBuilder& builder)
{
  builder.useSinglePrecision();
  const bool hasAttributes = checkBinaryLayout(file, builder);
  FacetCollector<float> facets(builder);
  const std::uint32_t triangles = trianglesOfStl(file.at(0, StlHeaderBytes));
  constexpr std::size_t NormalBytes = 3 * sizeof(float);
  BinaryInput input(file, StlHeaderBytes, std::endian::little);
  std::size_t begin = StlHeaderBytes;
  std::uint32_t triangle = 0;
  try
  {
    for (; triangle < triangles; ++triangle)
    {
      begin = input.offset();
      input.skip(NormalBytes);
      for (int k = 0; k < 3; ++k)
      {
        CornerWelder<float>::Point point;
        for (float& coordinate : point)
        {
          coordinate = input.take<float>();
        }
        facets.corner(point);
      }
      const auto attributes = input.take<std::uint16_t>();
      input.skip(hasAttributes ? attributes : 0);
      facets.endFacet();
    }
  }
  catch (const MeshError& error)
  {
    file.fail(begin, "triangle " + std::to_string(triangle) + ": " + error.what());
  }
  facets.finish();
}

/** Whether a word is this one, which is in lower case, in letters of any case. */
bool isStlWord(std::string_view word, std::string_view lower)
{
  return std::ranges::equal(
    word, lower, [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

bool beginsStlComment(std::string_view word)
{
  return word.starts_with('#') || word.starts_with(';') || word.starts_with("//");
}

/** Whether these bytes have neither a letter nor a digit, like those that some programs leave after
 * the last line. */
bool isNoWord(std::string_view bytes)
{
  return std::ranges::none_of(
    bytes, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

/** The column `Solid`: the number of the solid of each facet, in the order of their first facets.
 * Solids of the same name are one. A single one has no column. */
class SolidNumbers
{
public:
  explicit SolidNumbers(RawMeshBuilder& builder)
    : Builder(builder)
    , Labels(builder, ColumnOf::Elements, SolidName)
  {
  }

  void beginSolid(std::string name)
  {
    this->Name = std::move(name);
    this->Number = -1;
  }
  void addFacet()
  {
    if (this->Number < 0)
    {
      this->Number = this->numberOfName();
    }
    this->Labels.add(this->Number);
  }
  void finish()
  {
    if (this->Numbers.size() == MaxNames)
    {
      this->Labels.drop();
      this->Builder.note("The numbers of the solids are left out, since there are more than " +
                         std::to_string(MaxNames - 1) + '.');
      return;
    }
    this->Labels.finish();
    if (this->Numbers.size() > 1)
    {
      this->Builder.note(std::string("The column ") + SolidName + " has the number of the solid: " +
                         this->Listed + (this->Numbers.size() > MaxListed ? " ..." : "."));
    }
  }

private:
  static constexpr std::size_t MaxNames = 10000, MaxListed = 20;

  std::int64_t numberOfName()
  {
    if (this->Numbers.size() == MaxNames)
    {
      return 0;
    }
    const auto next = static_cast<std::int64_t>(this->Numbers.size());
    const auto [entry, isNew] = this->Numbers.try_emplace(this->Name, next);
    if (isNew && this->Numbers.size() <= MaxListed)
    {
      this->Listed += (next > 0 ? ", " : "") + std::to_string(next) + ' ' + inQuotes(this->Name);
    }
    return entry->second;
  }

  RawMeshBuilder& Builder;
  LabelColumn Labels;
  std::map<std::string, std::int64_t> Numbers; ///< by the name
  std::string Name, Listed;
  std::int64_t Number = -1; ///< of the current solid, once it has a facet
};

/** Reads the lines of an STL file in text. */
class StlTextReader
{
public:
  StlTextReader(InputFile& file, RawMeshBuilder& builder)
    : Scanner(file, '\0', &builder.workspace())
    , Solids(builder)
    , Facets(builder)
  {
  }

  void read()
  {
    bool ended = false;
    while (!this->Scanner.atEnd())
    {
      const std::string_view keyword = this->Scanner.tokenInLine();
      if (!beginsStlComment(keyword) && !(ended && isNoWord(keyword)))
      {
        ended = isStlWord(keyword, "endsolid");
        this->readLine(keyword);
      }
      this->Scanner.skipLine();
    }
    if (this->InLoop || !ended)
    {
      this->Scanner.fail("the file is truncated: it must end with 'endsolid'");
    }
    this->Solids.finish();
    this->Facets.finish();
  }

private:
  void readLine(std::string_view keyword)
  {
    if (isStlWord(keyword, "vertex"))
    {
      this->readVertex();
    }
    else if (isStlWord(keyword, "outer") || isStlWord(keyword, "endloop"))
    {
      this->readLoop(isStlWord(keyword, "outer"));
    }
    else if (isStlWord(keyword, "solid"))
    {
      this->readName();
    }
    else if (!isStlWord(keyword, "endsolid") && !isStlWord(keyword, "facet") &&
             !isStlWord(keyword, "endfacet"))
    {
      this->Scanner.fail(inQuotes(keyword) + " is not a keyword of an STL file");
    }
  }

  void readName()
  {
    constexpr std::size_t Most = 200;
    std::string name;
    for (std::string_view word = this->Scanner.tokenInLine(); !word.empty() && name.size() < Most;
         word = this->Scanner.tokenInLine())
    {
      name += (name.empty() ? "" : " ") + std::string(word.substr(0, Most));
    }
    this->Solids.beginSolid(std::move(name));
  }

  void readVertex()
  {
    if (!this->InLoop)
    {
      this->Scanner.fail("there is a vertex before 'outer loop'");
    }
    CornerWelder<double>::Point point;
    for (double& coordinate : point)
    {
      coordinate = this->Scanner.toNumber(this->Scanner.tokenInLine(), "a coordinate of a vertex");
    }
    this->Facets.corner(point);
  }

  void readLoop(bool begins)
  {
    if (this->InLoop == begins)
    {
      this->Scanner.fail(
        begins ? "a loop begins before the last one has ended" : "a loop ends that has not begun");
    }
    this->InLoop = begins;
    if (!begins)
    {
      this->Solids.addFacet();
      this->Facets.endFacet();
    }
  }

  TextScanner Scanner;
  SolidNumbers Solids;
  FacetCollector<double> Facets;
  bool InLoop = false;
};

/** Whether a file that begins with "solid" is text: its beginning has no bytes that texts lack. */
bool isPlainText(std::string_view start)
{
  return std::ranges::none_of(start,
    [](char c)
    {
      const auto byte = static_cast<unsigned char>(c);
      return byte < 32 && !isBlank(c);
    });
}

/** The text from its first line on that is not a comment. */
std::string_view afterStlComments(std::string_view start)
{
  std::string_view text = textStart(start);
  const char lineEnd = lineEndOf(text);
  while (beginsStlComment(text))
  {
    text = trimmed(afterLine(text, lineEnd));
  }
  return text;
}

bool beginsWith(std::string_view text, std::string_view lower)
{
  return isStlWord(text.substr(0, lower.size()), lower);
}

/** Whether the text begins with the line of a solid, which `after` follows. */
bool beginsSolid(std::string_view text, std::string_view& after)
{
  if (!beginsWith(text, "solid") || (text.size() > 5 && !isBlank(text[5])))
  {
    return false;
  }
  after = afterStlComments(afterLine(text, lineEndOf(text)));
  return true;
}

} // namespace

bool isTextStl(std::string_view start)
{
  std::string_view second;
  return beginsSolid(afterStlComments(start), second) &&
         (beginsWith(second, "facet") || beginsWith(second, "endsolid"));
}

void importStl(InputFile& file, RawMeshBuilder& builder)
{
  const std::string_view start = file.at(0, FormatBytes).substr(0, FormatBytes);
  std::string_view second;
  const bool isText =
    !isBinaryStl(start, file.size()) &&
    (isTextStl(start) || (beginsSolid(afterStlComments(start), second) && isPlainText(start)));
  isText ? StlTextReader(file, builder).read() : readBinary(file, builder);
}

} // namespace smg
