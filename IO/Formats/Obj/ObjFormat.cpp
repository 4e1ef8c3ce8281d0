// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/WrittenColors.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace smg
{

namespace
{

/** Reads the lines of an OBJ file. */
class ObjReader
{
public:
  ObjReader(InputFile& file, RawMeshBuilder& builder)
    : Scanner(file, '#', &builder.workspace())
    , Builder(builder)
    , Colors(builder, ColumnOf::Vertices)
  {
  }

  void read()
  {
    this->Scanner.locateErrors([this] { this->readLines(); });
    if (this->HasCornerAttributes)
    {
      this->Builder.note("Normals and texture coordinates are left out, since in OBJ files they "
                         "belong to corners of faces: save the mesh as PLY to have them of "
                         "vertices.");
    }
    if (this->HasGroups)
    {
      this->Builder.note("The groups and materials of the faces are left out.");
    }
    if (this->Lines > 0)
    {
      this->Builder.note(counted(this->Lines, "element of lines or points is left out.",
        "elements of lines or points are left out."));
    }
    if (this->Degenerate > 0)
    {
      this->Builder.note(
        std::to_string(this->Degenerate) +
        (this->Degenerate == 1 ? " face has fewer than three vertices: it is left out."
                               : " faces have fewer than three vertices: they are left out."));
    }
  }

private:
  void readLines()
  {
    this->Builder.numberVertices(1);
    while (!this->Scanner.atEnd())
    {
      const std::string_view keyword = this->Scanner.tokenInLine();
      if (keyword == "v")
      {
        this->readVertex();
      }
      else if (keyword == "f")
      {
        this->readFace();
      }
      else if (keyword == "vn" || keyword == "vt")
      {
        this->HasCornerAttributes = true;
      }
      else if (keyword == "l" || keyword == "p")
      {
        ++this->Lines;
      }
      else if (keyword == "g" || keyword == "usemtl")
      {
        this->HasGroups = true;
      }
      this->Scanner.skipLine();
    }
    this->Colors.finish();
    this->Builder.checkCorners();
  }

  /** A token of a line; a backslash at the end of a line continues it. */
  std::string_view nextToken()
  {
    while (true)
    {
      if (this->Continues)
      {
        if (!this->Scanner.tokenInLine().empty())
        {
          this->Scanner.fail("there is a backslash that is not at the end of its line");
        }
        this->Scanner.skipLine();
        this->Continues = false;
      }
      std::string_view token = this->Scanner.tokenInLine();
      if (token.ends_with('\\'))
      {
        this->Continues = true;
        token.remove_suffix(1);
      }
      if (!token.empty() || !this->Continues)
      {
        return token;
      }
    }
  }

  void readVertex()
  {
    const double x = this->Scanner.toNumber(this->nextToken(), "the coordinate x");
    const double y = this->Scanner.toNumber(this->nextToken(), "the coordinate y");
    const double z = this->Scanner.toNumber(this->nextToken(), "the coordinate z");
    this->Builder.vertex(x, y, z);
    std::array<double, 5> others{}; // a weight or a colour
    std::size_t count = 0;
    for (std::string_view token = this->nextToken(); !token.empty(); token = this->nextToken())
    {
      const std::optional<double> number = parseFinite(token);
      if (number && count < others.size())
      {
        others[count++] = *number;
      }
    }
    this->Colors.add(std::span(others).first(count));
  }

  void readFace()
  {
    this->Builder.setLine(this->Scanner.line());
    for (std::string_view token = this->nextToken(); !token.empty(); token = this->nextToken())
    {
      this->Builder.fanCorner(this->corner(token));
    }
    if (this->Builder.corners() < 3)
    {
      ++this->Degenerate;
    }
    this->Builder.endTriangles();
  }

  /** The number of the vertex in a token such as 7, 7/1, 7//2 or -1/2/3. */
  std::int64_t corner(std::string_view token)
  {
    const std::int64_t vertices = this->Builder.vertices();
    const std::int64_t number =
      this->Scanner.toInteger(token.substr(0, token.find('/')), "a vertex of a face");
    if (number == 0 || number < -vertices)
    {
      this->Scanner.fail("a face names vertex " + std::to_string(number) + ", where " +
                         std::to_string(vertices) + " vertices have come so far");
    }
    return number < 0 ? vertices + number + 1 : number;
  }

  TextScanner Scanner;
  RawMeshBuilder& Builder;
  TextColors Colors;
  bool HasCornerAttributes = false;
  bool HasGroups = false;
  std::int64_t Lines = 0;      ///< elements of lines or points
  std::int64_t Degenerate = 0; ///< faces of fewer than three vertices
  bool Continues = false;      ///< whether the next line continues this one
};

void importObj(InputFile& file, RawMeshBuilder& builder)
{
  ObjReader(file, builder).read();
}

/** Red, green and blue: other programs refuse a vertex with seven numbers. */
constexpr int ObjColorComponents = 3;

/** Polygons; vertices with their colours, normals and texture coordinates. */
class ObjWriter : public MeshFileWriter
{
public:
  ObjWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Out(path)
    , DoublePositions(info.doublePositions)
    , Columns(info)
    , Colors(this->Columns.colorsOfVertices())
    , Normals(this->Columns.ofVertices(NormalsName, 3, 3))
    , Texture(this->Columns.ofVertices(TextureCoordinatesName, 2, 3))
    , HasOpacity(this->Colors >= 0 &&
                 info.vertexColumns[static_cast<std::size_t>(this->Colors)].components > 3)
  {
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out << "v ";
        this->Out.position(position, this->DoublePositions);
        for (int k = 0; this->Colors >= 0 && k < ObjColorComponents; ++k)
        {
          const Column& colors = chunk.columns[static_cast<std::size_t>(this->Colors)];
          this->Out << ' ' << this->Written.share(colors, vertex, k);
        }
        this->Out << '\n';
        for (const auto& [keyword, column] :
          { std::pair("vn", this->Normals), std::pair("vt", this->Texture) })
        {
          if (column >= 0)
          {
            this->Out << keyword;
            this->Out.tuple(chunk.columns, column, vertex);
            this->Out << '\n';
          }
        }
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    chunk.forEach(
      [this](std::span<const std::int64_t> corners, std::size_t)
      {
        this->Out << 'f';
        for (const std::int64_t corner : corners)
        {
          // What belongs to a vertex has its number.
          const std::int64_t number = corner + 1;
          this->Out << ' ' << number;
          if (this->Texture >= 0 || this->Normals >= 0)
          {
            this->Out << '/';
          }
          if (this->Texture >= 0)
          {
            this->Out << number;
          }
          if (this->Normals >= 0)
          {
            this->Out << '/' << number;
          }
        }
        this->Out << '\n';
      });
  }

  WriteNotes finish() override
  {
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".obj");
    if (this->HasOpacity)
    {
      notes.push_back("The opacity of the colours is left out, since .obj files have no place for "
                      "it.");
    }
    this->Written.addNote(notes);
    return notes;
  }

private:
  TextOutput Out;
  bool DoublePositions;
  PlacedColumns Columns;
  std::ptrdiff_t Colors, Normals, Texture;
  bool HasOpacity;
  WrittenColors Written;
};

std::int64_t bytesOfObj(const MeshToWrite& written)
{
  constexpr double Keyword = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const bool hasColors = columns.colorsOfVertices() >= 0;
  double ofVertices = Keyword + positionCharacters(mesh.doublePositions) +
                      (hasColors ? realCharacters(false) * ObjColorComponents : 0);
  double ofCorner = numberCharacters(mesh.vertices);
  for (const std::ptrdiff_t column :
    { columns.ofVertices(NormalsName, 3, 3), columns.ofVertices(TextureCoordinatesName, 2, 3) })
  {
    ofVertices += column < 0 ? 0 : 1 + Keyword + tupleCharacters(mesh.vertexColumns, column);
    ofCorner += column < 0 ? 0 : numberCharacters(mesh.vertices);
  }
  return textBytes(mesh.vertices, ofVertices) + textBytes(mesh.cells, Keyword + 3 * ofCorner);
}

bool isObjKeyword(std::string_view word)
{
  constexpr std::string_view keywords[] = { "v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s",
    "mg", "mtllib", "usemtl", "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod",
    "shadow_obj", "trace_obj", "cstype", "deg" };
  return std::ranges::find(keywords, word) != std::end(keywords);
}

/** Whether every whole line is one of an OBJ file, and there is one. */
bool looksLikeObj(std::string_view start, std::optional<std::uint64_t> size)
{
  const bool whole = size && start.size() == *size;
  std::string_view text = withoutMark(start);
  const char lineEnd = lineEndOf(text);
  bool known = false;
  bool continued = false;
  while (!text.empty())
  {
    const std::size_t end = text.find(lineEnd);
    if (end == std::string_view::npos && !whole)
    {
      break;
    }
    const std::string_view line = trimmed(text.substr(0, end));
    const std::string_view word = line.substr(0, std::min(line.find_first_of(Blanks), line.size()));
    if (!word.empty() && !word.starts_with('#') && !continued)
    {
      if (!isObjKeyword(word))
      {
        return false;
      }
      known = true;
    }
    const std::size_t last = line.find_last_not_of(Blanks);
    continued = last != std::string_view::npos && line[last] == '\\';
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return known;
}

constexpr FileSuffix ObjSuffixes[] = { { ".obj", true, false, FileForm::Text } };
constexpr std::string_view ObjColumns[] = { NormalsName, ColorsName, TextureCoordinatesName };

} // namespace

const Format ObjFormat{
  .name = "OBJ",
  .suffixes = ObjSuffixes,
  .description = "text",
  .cells = "polygons",
  .vertexColumns = ObjColumns,
  .isReadByVtk = true,
  .looksLike = looksLikeObj,
  .parse = parseWith<importObj>,
  .bytes = bytesOfObj,
  .writer = makeWriter<ObjWriter>,
};

} // namespace smg
