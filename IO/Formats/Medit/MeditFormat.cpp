// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Medit/MeditFormat.h"

#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** Sections of elements that become cells, and their corners. */
struct Section
{
  std::string_view keyword;
  std::size_t corners;
};
constexpr std::array<Section, 6> Sections{ { { "Triangles", 3 }, { "Quadrilaterals", 4 },
  { "Tetrahedra", 4 }, { "Hexahedra", 8 }, { "Prisms", 6 }, { "Pyramids", 5 } } };

/** Whether the section has cells of higher order, such as TetrahedraP2 and HexahedraQ2. */
bool isOfHigherOrder(std::string_view keyword)
{
  return std::ranges::any_of(Sections,
    [keyword](const Section& section)
    {
      const std::string_view order =
        keyword.substr(std::min(section.keyword.size(), keyword.size()));
      return keyword.starts_with(section.keyword) && order.size() == 2 &&
             (order[0] == 'P' || order[0] == 'Q');
    });
}

/** Reads the sections of a Medit file. */
class MeditReader
{
public:
  MeditReader(InputFile& file, RawMeshBuilder& builder)
    : Scanner(file, '#', &builder.workspace())
    , Builder(builder)
    , VertexReferences(builder, ColumnOf::Vertices, ReferenceName)
    , ElementReferences(builder, ColumnOf::Elements, ReferenceName)
  {
  }

  void read()
  {
    // The vertices may come after the elements.
    this->Builder.numberVertices(1);
    this->Scanner.locateErrors(
      [this]
      {
        this->readSections();
        this->Builder.checkCorners();
      });
    this->VertexReferences.finish();
    this->ElementReferences.finish();
  }

private:
  void readSections()
  {
    while (!this->Scanner.atEnd())
    {
      const std::string keyword(this->Scanner.token());
      if (keyword == "End")
      {
        break;
      }
      this->readSection(keyword);
    }
  }

  void readSection(const std::string& keyword)
  {
    if (keyword == "MeshVersionFormatted")
    {
      this->Scanner.integer("the version");
      return;
    }
    if (keyword == "Dimension")
    {
      this->readDimension();
      return;
    }
    if (keyword == "Vertices")
    {
      this->readVertices();
      return;
    }
    for (const Section& section : Sections)
    {
      if (keyword == section.keyword)
      {
        this->readElements(section);
        return;
      }
    }
    if (!std::isalpha(static_cast<unsigned char>(keyword[0])))
    {
      this->Scanner.fail(inQuotes(keyword) + " stands where a keyword should be: a section is "
                                             "longer than its number of entries");
    }
    if (isOfHigherOrder(keyword))
    {
      this->Scanner.fail("cells of higher order, as the section " + inQuotes(keyword) +
                         " has them, are not read: save the mesh with straight cells");
    }
    this->skipSection();
  }

  /** Skips the numbers of an unused section. */
  void skipSection()
  {
    std::string_view next = this->Scanner.peek();
    while (!next.empty() && !std::isalpha(static_cast<unsigned char>(next[0])))
    {
      this->Scanner.skipLine();
      next = this->Scanner.peek();
    }
  }

  void readDimension()
  {
    this->Dimension = this->Scanner.integer("the dimension");
    if (this->Dimension != 2 && this->Dimension != 3)
    {
      this->Scanner.fail("the dimension must be 2 or 3");
    }
  }

  void readVertices()
  {
    if (this->Builder.vertices() > 0)
    {
      this->Scanner.fail("there are two sections 'Vertices'");
    }
    const std::int64_t count = this->Scanner.count("the number of vertices", 4);
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::array<double, 3> point{};
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
      {
        point[axis] = this->Scanner.number("a coordinate of a vertex");
      }
      this->Builder.vertex(point[0], point[1], point[2]);
      this->VertexReferences.add(this->reference());
    }
  }

  void readElements(const Section& section)
  {
    const std::int64_t count = this->Scanner.count("the number of elements", 2 * section.corners);
    std::array<std::int64_t, 8> storage{};
    const std::span<std::int64_t> corners = std::span(storage).first(section.corners);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (std::int64_t& corner : corners)
      {
        corner = this->Scanner.integer("a vertex of an element");
      }
      this->Builder.setLine(this->Scanner.line());
      this->add(section, corners);
      this->ElementReferences.add(this->reference());
    }
  }

  void add(const Section& section, std::span<const std::int64_t> corners)
  {
    switch (section.keyword[0])
    {
      case 'Q':
        this->Builder.polygon(corners);
        break;
      case 'T':
        corners.size() == 3
          ? this->Builder.triangle(corners[0], corners[1], corners[2])
          : this->Builder.tetrahedron(corners[0], corners[1], corners[2], corners[3]);
        break;
      default:
        corners.size() == 6
          // The first triangle of a prism faces inwards here, and outwards in VTK.
          ? this->Builder.solid(std::array<std::int64_t, 6>{
              corners[0], corners[2], corners[1], corners[3], corners[5], corners[4] })
          : this->Builder.solid(corners);
    }
  }

  /** The label at the end of the line of an entry; some writers omit it. */
  std::int64_t reference()
  {
    const std::string_view token = this->Scanner.tokenInLine();
    return token.empty() ? 0 : this->Scanner.toInteger(token, "a label");
  }

  TextScanner Scanner;
  RawMeshBuilder& Builder;
  LabelColumn VertexReferences, ElementReferences;
  std::int64_t Dimension = 3;
};

} // namespace

void importMedit(InputFile& file, RawMeshBuilder& builder)
{
  MeditReader(file, builder).read();
}

namespace
{

bool isMedit(std::string_view start)
{
  return textAfterComments(start).starts_with("MeshVersionFormatted");
}

constexpr FileSuffix MeditSuffixes[] = { { ".mesh", true, true, true } };

} // namespace

const Format MeditFormat{
  .name = "Medit",
  .suffixes = MeditSuffixes,
  .attributes = "references of vertices and cells",
  .hasSign = isMedit,
  .parse = parseWith<importMedit>,
  .share = { 200, 4 },
  .bytes = bytesOfMedit,
  .restore = writeRestoredMedit,
};

namespace
{

/** Writes elements by their corners, which count from 1, and their references. */
class MeditElements
{
public:
  MeditElements(TextOutput& out, RestoredMesh& mesh, std::ptrdiff_t references)
    : Out(out)
    , Mesh(mesh)
    , References(references)
  {
  }

  /** Writes those for which `choose`, given their number of corners, returns true. */
  template <class Choose>
  void write(std::string_view keyword, std::int64_t count, Choose&& choose)
  {
    if (count == 0)
    {
      return;
    }
    this->Out << keyword << '\n' << count << '\n';
    for (RestoredElements elements; this->Mesh.next(elements);)
    {
      elements.forEach(
        [&](std::span<const std::int64_t> corners, std::size_t element)
        {
          if (choose(corners.size()))
          {
            this->write(elements, element, corners);
          }
        });
    }
    this->Mesh.rewindElements();
  }

private:
  void write(
    const RestoredElements& elements, std::size_t element, std::span<const std::int64_t> corners)
  {
    if (corners.size() <= 4)
    {
      this->writeCell(elements, element, corners);
      return;
    }
    forEachFanTriangle(
      corners, [&](const auto& triangle) { this->writeCell(elements, element, triangle); });
  }

  void writeCell(
    const RestoredElements& elements, std::size_t element, std::span<const std::int64_t> corners)
  {
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      this->Out << (k > 0 ? " " : "") << corners[k] + 1;
    }
    this->Out.tuple(elements.columns, this->References, element, " 0");
    this->Out << '\n';
  }

  TextOutput& Out;
  RestoredMesh& Mesh;
  std::ptrdiff_t References; ///< column
};

} // namespace

WriteNotes writeRestoredMedit(RestoredMesh& mesh, const std::filesystem::path& path)
{
  TextOutput out(path);
  const RestoredInfo& info = mesh.info();
  PlacedColumns columns(info);
  const std::ptrdiff_t references = columns.integerOfVertices({ ReferenceName, MarkerName });
  out << "MeshVersionFormatted " << (info.doublePositions ? 2 : 1) << "\nDimension 3\nVertices\n"
      << info.vertices << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < positions.size(); i += 3)
    {
      out.position(positions.subspan(i, 3), info.doublePositions);
      out.tuple(vertices.columns, references, i / 3, " 0");
      out << '\n';
    }
  }
  MeditElements writer(out, mesh, columns.integerOfElements({ ReferenceName, PhysicalTagName }));
  if (info.cellType == CellType::Triangle)
  {
    // All triangles of the stream, except for the two of each quadrilateral.
    writer.write("Triangles", info.cells - 2 * info.quadrilaterals,
      [](std::size_t corners) { return corners != 4; });
    writer.write(
      "Quadrilaterals", info.quadrilaterals, [](std::size_t corners) { return corners == 4; });
  }
  else
  {
    writer.write("Tetrahedra", info.elements, [](std::size_t) { return true; });
  }
  out << "End\n";
  out.finish();
  WriteNotes notes = columns.leftOut(".mesh");
  if (info.quadrilaterals > 0 && info.quadrilaterals < info.elements)
  {
    notes.push_back("The quadrilaterals come after the triangles, as the format has it.");
  }
  if (info.cellType == CellType::Triangle && info.maxCorners > 4)
  {
    notes.push_back("Polygons of more than four corners are written as triangles.");
  }
  return notes;
}

std::int64_t bytesOfMedit(const MeshToWrite& written)
{
  constexpr double NoReference = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const std::ptrdiff_t ofVertices = columns.integerOfVertices({ ReferenceName, MarkerName });
  const std::ptrdiff_t ofCells = columns.integerOfElements({ ReferenceName, PhysicalTagName });
  return textBytes(mesh.vertices, positionCharacters(mesh.doublePositions) +
                                    tupleCharacters(mesh.vertexColumns, ofVertices, NoReference)) +
         textBytes(mesh.cells, cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells, NoReference));
}

} // namespace smg
