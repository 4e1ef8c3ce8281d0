// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Stl/StlFormat.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Files/TextStart.h"
#include "IO/Formats/Stl/StlLayout.h"
#include "IO/Import/CornerWelder.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Import/TriangleRuns.h"
#include "smg/Error.h"

#include <bit>
#include <cmath>
#include <string>

namespace smg
{

namespace
{

/** Receives the facets: passes their corners to the welder, and writes the numbers of their corners
 * to a file. */
class FacetCollector
{
public:
  explicit FacetCollector(RawMeshBuilder& builder)
    : Builder(builder)
    , Welder(builder)
    , Sizes(builder.workspace())
  {
  }

  void corner(const CornerWelder::Point& point)
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
    this->Builder.useSinglePrecision();
    this->Welder.makeVertices();
    TriangleFan fan(this->Builder);
    RecordFile<std::uint32_t>::Reader sizes(this->Sizes);
    for (std::uint32_t size = 0; sizes.next(size);)
    {
      for (std::uint32_t k = 0; k < size; ++k)
      {
        fan.corner(this->Welder.next());
      }
      fan.end();
    }
  }

private:
  RawMeshBuilder& Builder;
  CornerWelder Welder;
  RecordFile<std::uint32_t> Sizes;
  std::uint32_t Size = 0; ///< corners so far of the current facet
};

void readBinary(InputFile& file, FacetCollector& facets)
{
  const std::string_view header = file.at(0, StlHeaderBytes);
  const std::uint64_t end = stlBytes(header);
  const std::uint32_t triangles = trianglesOfStl(header);
  if (file.size() < end)
  {
    throw Error(file.name() + ": the file is truncated: " + std::to_string(triangles) +
                " triangles take " + std::to_string(end) + " bytes, it has " +
                std::to_string(file.size()) + '.');
  }
  if (file.size() - end >= StlTriangleBytes)
  {
    file.fail(end, "there is more after the last of " + std::to_string(triangles) +
                     " triangles: their number at the beginning is wrong");
  }
  constexpr std::size_t normalBytes = 3 * sizeof(float);
  for (std::size_t offset = StlHeaderBytes; offset < end; offset += StlTriangleBytes)
  {
    const char* at = file.at(offset, StlTriangleBytes).data() + normalBytes;
    for (int k = 0; k < 3; ++k)
    {
      CornerWelder::Point point;
      for (float& coordinate : point)
      {
        coordinate = numberAt<float>(at, std::endian::little);
        at += sizeof(float);
      }
      try
      {
        facets.corner(point);
      }
      catch (const MeshError& error)
      {
        file.fail(offset, "triangle " +
                            std::to_string((offset - StlHeaderBytes) / StlTriangleBytes) + ": " +
                            error.what());
      }
    }
    facets.endFacet();
  }
}

/** Reads the lines of an STL file in text. */
class StlTextReader
{
public:
  /** `helpers`: see TextScanner. */
  StlTextReader(InputFile& file, Workspace* helpers, FacetCollector& facets)
    : Scanner(file, '\0', helpers)
    , Facets(facets)
  {
  }

  void read()
  {
    bool ended = false;
    while (!this->Scanner.atEnd())
    {
      const std::string_view keyword = this->Scanner.tokenInLine();
      ended = keyword == "endsolid";
      if (keyword == "vertex")
      {
        this->readVertex();
      }
      else if (keyword == "outer" || keyword == "endloop")
      {
        this->readLoop(keyword == "outer");
      }
      else if (!ended && keyword != "solid" && keyword != "facet" && keyword != "endfacet")
      {
        this->Scanner.fail(inQuotes(keyword) + " is not a keyword of an STL file");
      }
      this->Scanner.skipLine();
    }
    if (this->InLoop || !ended)
    {
      this->Scanner.fail("the file is truncated: it must end with 'endsolid'");
    }
  }

private:
  void readVertex()
  {
    if (!this->InLoop)
    {
      this->Scanner.fail("there is a vertex before 'outer loop'");
    }
    CornerWelder::Point point;
    for (float& coordinate : point)
    {
      coordinate = static_cast<float>(
        this->Scanner.toNumber(this->Scanner.tokenInLine(), "a coordinate of a vertex"));
      if (!std::isfinite(coordinate))
      {
        this->Scanner.fail("a coordinate is beyond the range of single precision");
      }
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
      this->Facets.endFacet();
    }
  }

  TextScanner Scanner;
  FacetCollector& Facets;
  bool InLoop = false;
};

} // namespace

void importStl(InputFile& file, RawMeshBuilder& builder)
{
  const std::string_view header = file.at(0, StlHeaderBytes);
  const bool text = !isBinaryStl(header, file.size()) && TextScanner(file).peek() == "solid";
  if (!text && file.size() < StlHeaderBytes)
  {
    throw Error(file.name() + ": the file is too short for an STL file.");
  }
  FacetCollector facets(builder);
  text ? StlTextReader(file, &builder.workspace(), facets).read() : readBinary(file, facets);
  facets.finish();
  if (!text && file.size() > stlBytes(file.at(0, StlHeaderBytes)))
  {
    builder.note("The bytes after the last triangle that the header promises are left out.");
  }
}

namespace
{

/** Whether the text begins an STL file: "solid", any name, then a facet or the end. */
bool isTextStl(std::string_view text)
{
  if (!text.starts_with("solid") || (text.size() > 5 && !isBlank(text[5])))
  {
    return false;
  }
  const std::string_view second = trimmed(text.substr(std::min(text.find('\n'), text.size())));
  return second.starts_with("facet") || second.starts_with("endsolid");
}

bool looksLikeStl(std::string_view start, std::optional<std::uint64_t> size)
{
  return (size && isBinaryStl(start, *size)) || isTextStl(textStart(start));
}

constexpr FileSuffix StlSuffixes[] = { { ".stl", true, false } };

} // namespace

const Format StlFormat{
  .name = "STL",
  .suffixes = StlSuffixes,
  .attributes = "none",
  .looksRight = looksLikeStl,
  .parse = parseWith<importStl>,
  .share = { 100, 3 },
  .bytes = bytesOfStl,
  .restore = writeRestoredStl,
};

} // namespace smg
