// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/WrittenColors.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Off/BinaryOff.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <cmath>
#include <string>

namespace smg
{

namespace
{

/** The length of the keyword at the beginning of a text, OFF or one of its variants, such as COFF
 * or STN4OFF; 0: there is none. The number of vertices may follow without a blank, as in files of
 * ModelNet. */
std::size_t lengthOfKeyword(std::string_view text)
{
  const std::size_t at = text.find("OFF");
  if (at > 6 || text.substr(0, at).find_first_not_of("STCN4n") != std::string_view::npos)
  {
    return 0;
  }
  const std::size_t end = at + 3;
  const bool ends = end == text.size() || isBlank(text[end]) || text[end] == '#' ||
                    (text[end] >= '0' && text[end] <= '9');
  return ends ? end : 0;
}

/** Reads the keyword, if any, and refuses files that are not three-dimensional. */
void readKeyword(TextScanner& scanner, OffHeader& header)
{
  const std::string first(scanner.peek());
  const std::string keyword = first.substr(0, lengthOfKeyword(first));
  if (keyword.empty())
  {
    return;
  }
  if (keyword.find_first_of("4n") != std::string::npos)
  {
    scanner.fail("the vertices of a " + inQuotes(keyword) + " file are not points of space");
  }
  scanner.moveTo(scanner.offset() + keyword.size());
  if (scanner.peek() == "BINARY")
  {
    header.binary = true;
    scanner.tokenInLine();
    scanner.skipLine();
    header.body = scanner.offset();
  }
  header.textureCoordinates = keyword.starts_with("ST");
  header.colors = keyword.find('C') != std::string::npos;
  header.normals = keyword.find('N') != std::string::npos;
}

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
    if (attributes.any() || i == 0)
    {
      numbers.read(scanner);
      attributes.add(numbers.all());
    }
    scanner.skipLine();
  }
  attributes.finish();
}

void readFaces(TextScanner& scanner, std::int64_t faces, RawMeshBuilder& builder)
{
  TextColors colors(builder, ColumnOf::Elements);
  LineNumbers numbers;
  for (std::int64_t i = 0; i < faces; ++i)
  {
    const std::int64_t corners = scanner.count("the number of corners of a face", 2);
    for (std::int64_t k = 0; k < corners; ++k)
    {
      builder.fanCorner(scanner.integer("a corner of a face"));
    }
    builder.endTriangles();
    numbers.read(scanner);
    colors.add(numbers.all());
    scanner.skipLine();
  }
  colors.finish();
}

/** Reads a file up to its first vertex; a text with the scanner, which is at its beginning. Throws
 * Error if it is not an OFF file of points in space, or too short for its counts. */
OffHeader readOffHeader(InputFile& file, TextScanner& scanner)
{
  OffHeader header;
  readKeyword(scanner, header);
  if (header.binary)
  {
    readBinaryOffCounts(file, header);
    return header;
  }
  header.vertices = scanner.count("the number of vertices", 6);
  header.faces = scanner.count("the number of faces", 2);
  scanner.integer("the number of edges");
  return header;
}

void importOff(InputFile& file, RawMeshBuilder& builder)
{
  TextScanner scanner(file, '#', &builder.workspace());
  const OffHeader header = readOffHeader(file, scanner);
  builder.numberVertices(0, header.vertices);
  if (header.binary)
  {
    readBinaryOff(file, header, builder);
    return;
  }
  scanner.locateErrors(
    [&]
    {
      readVertices(scanner, header, builder);
      readFaces(scanner, header.faces, builder);
      if (!scanner.atEnd())
      {
        throw MeshError("there is more after the last face: the counts at the beginning are wrong");
      }
    });
}

/** Writes a colour; numbers from 0 to 1 with a decimal point, since those without are bytes. */
void writeColor(TextOutput& out, const std::vector<Column>& columns, std::ptrdiff_t column,
  std::size_t tuple, WrittenColors& written)
{
  if (column < 0 || columns[static_cast<std::size_t>(column)].spec.type == ScalarType::UInt8)
  {
    out.tuple(columns, column, tuple);
    return;
  }
  const Column& colors = columns[static_cast<std::size_t>(column)];
  for (int k = 0; k < colors.spec.components; ++k)
  {
    const float value = written.share(colors, tuple, k);
    out << ' ' << value << (value == std::floor(value) ? ".0" : "");
  }
}

/** Text: normals, colours and texture coordinates of vertices, colours of faces. */
class OffWriter : public MeshFileWriter
{
public:
  OffWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Out(path)
    , DoublePositions(info.doublePositions)
    , Columns(info)
    , Normals(this->Columns.ofVertices(NormalsName, 3, 3))
    , Colors(this->Columns.colorsOfVertices())
    , Texture(this->Columns.ofVertices(TextureCoordinatesName, 2, 2))
    , FaceColors(this->Columns.colorsOfElements())
  {
    this->Out << (this->Texture < 0 ? "" : "ST") << (this->Colors < 0 ? "" : "C")
              << (this->Normals < 0 ? "" : "N") << "OFF\n"
              << info.vertices << ' ' << info.elements << " 0\n";
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out.position(position, this->DoublePositions);
        this->Out.tuple(chunk.columns, this->Normals, vertex);
        writeColor(this->Out, chunk.columns, this->Colors, vertex, this->Written);
        this->Out.tuple(chunk.columns, this->Texture, vertex);
        this->Out << '\n';
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        this->Out << corners.size();
        this->Out.corners(corners, 0);
        writeColor(this->Out, chunk.columns, this->FaceColors, element, this->Written);
        this->Out << '\n';
      });
  }

  WriteNotes finish() override
  {
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".off");
    this->Written.addNote(notes);
    return notes;
  }

private:
  TextOutput Out;
  bool DoublePositions;
  PlacedColumns Columns;
  std::ptrdiff_t Normals, Colors, Texture, FaceColors;
  WrittenColors Written;
};

std::int64_t bytesOfOff(const MeshToWrite& written)
{
  constexpr double CountOfCorners = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  double ofVertices = positionCharacters(mesh.doublePositions);
  for (const std::ptrdiff_t column : { columns.ofVertices(NormalsName, 3, 3),
         columns.colorsOfVertices(), columns.ofVertices(TextureCoordinatesName, 2, 2) })
  {
    ofVertices += tupleCharacters(mesh.vertexColumns, column);
  }
  const std::ptrdiff_t faceColors = columns.colorsOfElements();
  return textBytes(mesh.vertices, ofVertices) +
         textBytes(mesh.cells, CountOfCorners + 3 * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, faceColors));
}

bool isOff(std::string_view start)
{
  return lengthOfKeyword(textAfterComments(start)) > 0;
}

std::optional<FileCounts> countsOfOff(InputFile& file, const MeshPart&)
{
  TextScanner scanner(file, '#');
  const OffHeader header = readOffHeader(file, scanner);
  FileCounts counts;
  counts.mesh.vertices = header.vertices;
  counts.mesh.cells = header.faces;
  counts.counted = true;
  return counts;
}

constexpr FileSuffix OffSuffixes[] = { { ".off", true, false, FileForm::Text } };
constexpr std::string_view OffColumns[] = { NormalsName, ColorsName, TextureCoordinatesName };

} // namespace

const Format OffFormat{
  .name = "OFF",
  .suffixes = OffSuffixes,
  .description = "text and binary",
  .cells = "polygons",
  .vertexColumns = OffColumns,
  .hasMagic = isOff,
  .parse = parseWith<importOff>,
  .counts = countsOfOff,
  .bytes = bytesOfOff,
  .writer = makeWriter<OffWriter>,
};

} // namespace smg
