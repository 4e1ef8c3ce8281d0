// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Container/AttributeNames.h"
#include "IO/Import/Formats.h"
#include "IO/Import/OffHeader.h"
#include "IO/Import/TextColors.h"
#include "IO/Import/TextScanner.h"
#include "IO/Import/TriangleRuns.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** Reads the keyword, if there is one, and refuses what is not a text in three dimensions. */
void readKeyword(TextScanner& scanner, OffHeader& header)
{
  const std::string keyword(scanner.peek());
  if (!keyword.ends_with("OFF"))
  {
    return;
  }
  if (keyword.find_first_of("4n") != std::string::npos)
  {
    scanner.fail("the vertices of a " + inQuotes(keyword) + " file are not points of space");
  }
  scanner.tokenInLine();
  if (scanner.peek() == "BINARY")
  {
    scanner.fail("binary OFF files are not read: write it as text, or as PLY");
  }
  header.textureCoordinates = keyword.starts_with("ST");
  header.colors = keyword.find('C') != std::string::npos;
  header.normals = keyword.find('N') != std::string::npos;
}

/** More numbers than can stand behind the coordinates of a vertex, or behind a face. */
constexpr std::size_t MostNumbers = 16;

/** The numbers up to the end of the line. */
class LineNumbers
{
public:
  void read(TextScanner& scanner, const char* what)
  {
    this->Count = 0;
    for (std::string_view token = scanner.tokenInLine();
         !token.empty() && this->Count < MostNumbers; token = scanner.tokenInLine())
    {
      this->Numbers[this->Count++] = scanner.toNumber(token, what);
    }
  }
  std::span<const double> all() const { return std::span(this->Numbers).first(this->Count); }

private:
  std::array<double, MostNumbers> Numbers{};
  std::size_t Count = 0;
};

/** Columns of what stands behind the coordinates: normals, colours, texture coordinates. */
class OffAttributes
{
public:
  OffAttributes(const OffHeader& header, RawMeshBuilder& builder)
    : Header(header)
    , Builder(builder)
    , Colors(builder, TextColors::Of::Vertices)
  {
  }

  bool any() const
  {
    return this->Header.normals || this->Header.colors || this->Header.textureCoordinates;
  }

  void add(std::span<const double> numbers)
  {
    if (!this->Begun)
    {
      this->begin(numbers.size());
    }
    if (this->Used == 0)
    {
      return;
    }
    if (numbers.size() != this->Used)
    {
      throw MeshError("a vertex has " + std::to_string(numbers.size()) +
                      " numbers behind its coordinates, those before it have " +
                      std::to_string(this->Used));
    }
    numbers = this->put(this->Normals, numbers, this->Header.normals ? 3 : 0);
    const std::size_t last = this->Header.textureCoordinates ? 2 : 0;
    this->Colors.add(numbers.first(numbers.size() - last));
    this->put(this->Texture, numbers.last(last), last);
  }

private:
  /** Files whose vertices have not what the keyword says are read without. */
  void begin(std::size_t numbers)
  {
    this->Begun = true;
    const std::size_t others =
      (this->Header.normals ? 3 : 0) + (this->Header.textureCoordinates ? 2 : 0);
    const std::size_t colors = numbers - std::min(others, numbers);
    if (numbers < others || (this->Header.colors ? colors != 3 && colors != 4 : colors != 0))
    {
      this->Builder.note("The vertices have not the numbers that the keyword of the file promises: "
                         "all but their coordinates is left out.");
      return;
    }
    this->Used = numbers;
    if (this->Header.normals)
    {
      this->Normals = this->Builder.addVertexColumn({ NormalsName, ScalarType::Float32, 3 });
    }
    if (this->Header.textureCoordinates)
    {
      this->Texture =
        this->Builder.addVertexColumn({ TextureCoordinatesName, ScalarType::Float32, 2 });
    }
  }

  /** Appends the first `count` numbers to the column; answers the others. */
  std::span<const double> put(int column, std::span<const double> numbers, std::size_t count)
  {
    std::array<float, 3> tuple{};
    for (std::size_t k = 0; k < std::min(tuple.size(), count); ++k)
    {
      tuple[k] = static_cast<float>(numbers[k]);
    }
    this->Builder.vertexTuples(column, std::as_bytes(std::span(tuple).first(count)));
    return numbers.subspan(count);
  }

  OffHeader Header;
  RawMeshBuilder& Builder;
  TextColors Colors;
  int Normals = -1, Texture = -1;
  bool Begun = false;
  std::size_t Used = 0; ///< numbers behind the coordinates; 0: they are left out
};

void readVertices(TextScanner& scanner, const OffHeader& header, RawMeshBuilder& builder)
{
  OffAttributes attributes(header, builder);
  LineNumbers numbers;
  for (std::int64_t i = 0; i < header.vertices; ++i)
  {
    const double x = scanner.number("the coordinate x of a vertex");
    const double y = scanner.number("the coordinate y of a vertex");
    const double z = scanner.number("the coordinate z of a vertex");
    builder.vertex(x, y, z);
    if (attributes.any())
    {
      numbers.read(scanner, "a number behind the coordinates of a vertex");
      attributes.add(numbers.all());
    }
    scanner.skipLine();
  }
}

void readFaces(
  TextScanner& scanner, std::int64_t faces, std::int64_t vertices, RawMeshBuilder& builder)
{
  TriangleFan fan(builder);
  TextColors colors(builder, TextColors::Of::Faces);
  LineNumbers numbers;
  for (std::int64_t i = 0; i < faces; ++i)
  {
    const std::int64_t corners = scanner.count("the number of corners of a face", 2);
    for (std::int64_t k = 0; k < corners; ++k)
    {
      const std::int64_t corner = scanner.integer("a corner of a face");
      if (corner < 0 || corner >= vertices)
      {
        scanner.fail("the corner " + std::to_string(corner) + " is none of the " +
                     std::to_string(vertices) + " vertices");
      }
      fan.corner(corner);
    }
    fan.end();
    numbers.read(scanner, "a number behind the corners of a face");
    colors.add(numbers.all());
    scanner.skipLine();
  }
}

} // namespace

OffHeader readOffHeader(TextScanner& scanner)
{
  OffHeader header;
  readKeyword(scanner, header);
  header.vertices = scanner.count("the number of vertices", 6);
  header.faces = scanner.count("the number of faces", 2);
  scanner.integer("the number of edges");
  return header;
}

void importOff(InputFile& file, RawMeshBuilder& builder)
{
  TextScanner scanner(file, '#');
  const OffHeader header = readOffHeader(scanner);
  try
  {
    readVertices(scanner, header, builder);
    readFaces(scanner, header.faces, header.vertices, builder);
    if (!scanner.atEnd())
    {
      scanner.fail("there is more after the last face: the counts at the beginning are wrong");
    }
  }
  catch (const MeshError& error)
  {
    scanner.fail(error.what());
  }
}

} // namespace smg
