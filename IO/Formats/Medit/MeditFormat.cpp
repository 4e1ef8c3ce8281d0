// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Export/GroupElements.h"
#include "IO/Export/MeshFileWriter.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Medit/MeditSections.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace smg
{

namespace
{

/** Whether the section has cells of higher order, such as TetrahedraP2 and HexahedraQ2. */
bool isOfHigherOrder(std::string_view keyword)
{
  return std::ranges::any_of(MeditSections,
    [keyword](const MeditSection& section)
    {
      if (section.dimension == 1)
      {
        return false;
      }
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
    , Groups(builder)
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
        this->VertexReferences.finish();
        this->VertexLabels.groupVertices(this->Builder, this->VertexReferences.column(), 1);
        this->Groups.finish();
        this->Builder.checkCorners();
      });
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
    const auto* const section = std::ranges::find(MeditSections, keyword, &MeditSection::keyword);
    if (section != MeditSections.end())
    {
      this->readElements(*section);
      return;
    }
    const auto* const list = std::ranges::find(MeditLists, keyword, &MeditList::keyword);
    if (list != MeditLists.end() && !this->Builder.looks())
    {
      this->readList(*list);
      return;
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
    if (this->Builder.looks())
    {
      this->skipSection();
      return;
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::array<double, 3> point{};
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
      {
        point[axis] = this->Scanner.number("a coordinate of a vertex");
      }
      this->Builder.vertex(point[0], point[1], point[2]);
      const std::int64_t reference = this->reference();
      this->VertexReferences.add(reference);
      this->VertexLabels.add(reference);
    }
  }

  void readElements(const MeditSection& section)
  {
    const std::int64_t count = this->Scanner.count("the number of elements", 2 * section.corners);
    std::array<std::int64_t, 8> storage{};
    const std::span<std::int64_t> corners = std::span(storage).first(section.corners);
    this->Groups.beginSection(section, count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (std::int64_t& corner : corners)
      {
        corner = this->Scanner.integer("a vertex of an element");
      }
      this->Builder.setLine(this->Scanner.line());
      const std::int64_t reference = this->reference();
      this->Groups.add(section, corners, reference);
      if (section.dimension > 1)
      {
        this->ElementReferences.add(reference, section.dimension);
      }
    }
  }

  void readList(const MeditList& list)
  {
    const std::int64_t count = this->Scanner.count("the number of entries", 2);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t number = this->Scanner.integer("a number of the list");
      this->Builder.setLine(this->Scanner.line());
      this->Groups.list(list, number);
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
  LabelGroups VertexLabels;
  MeditGroups Groups;
  std::int64_t Dimension = 3;
};

void importMedit(InputFile& file, RawMeshBuilder& builder)
{
  MeditReader(file, builder).read();
}

/** Tetrahedra, or triangles and then quadrilaterals, then facets in groups; vertices and cells with
 * their references. Those of facets and, if no column has them, of cells are the numbers of their
 * groups. */
class MeditWriter : public MeshFileWriter
{
public:
  MeditWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Out(path)
    , Info(info)
    , Columns(info)
    , VertexReferences(this->Columns.integerOfVertices({ ReferenceName, MarkerName }))
    , References(this->Columns.integerOfElements({ ReferenceName, PhysicalTagName }))
    , Sets(this->Columns.integerOfElements({ CellGroupsName }))
    // All triangles of the stream, except for the two of each quadrilateral.
    , Triangles(info.cellType == CellType::Triangle ? info.cells - 2 * info.quadrilaterals : 0)
    , WritesQuadrilaterals(this->Triangles == 0)
  {
    this->Out << "MeshVersionFormatted " << (info.doublePositions ? 2 : 1)
              << "\nDimension 3\nVertices\n"
              << info.vertices << '\n';
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out.position(position, this->Info.doublePositions);
        this->Out.tuple(chunk.columns, this->VertexReferences, vertex, " 0");
        this->Out << '\n';
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    if (chunk.first == 0)
    {
      this->beginSection();
    }
    const bool isSurface = this->Info.cellType == CellType::Triangle;
    chunk.forEachUpTo(4,
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        if (isSurface && (corners.size() == 4) != this->WritesQuadrilaterals)
        {
          return;
        }
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
          this->Out << (k > 0 ? " " : "") << corners[k] + 1;
        }
        const bool byGroups = this->Info.groups && this->Sets >= 0 && this->References < 0;
        byGroups ? void(this->Out << ' ' << this->numberOf(chunk.columns, element))
                 : this->Out.tuple(chunk.columns, this->References, element, " 0");
        this->Out << '\n';
      });
  }

  /** For the section of the quadrilaterals, which comes after the triangles. */
  bool needsElementsAgain() override
  {
    const bool again = !this->WritesQuadrilaterals && this->Info.quadrilaterals > 0;
    this->WritesQuadrilaterals = true;
    return again;
  }

  WriteNotes finish() override
  {
    this->writeFacets();
    this->Out << "End\n";
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".mesh");
    this->noteGroups(notes);
    if (this->Info.quadrilaterals > 0 && this->Info.quadrilaterals < this->Info.elements)
    {
      notes.push_back("The quadrilaterals come after the triangles, as the format has it.");
    }
    return notes;
  }

private:
  /** The number of the first group of a cell; 0: it is in none. */
  std::int64_t numberOf(const std::vector<Column>& columns, std::size_t element) const
  {
    const GroupSet set = columns[std::size_t(this->Sets)].as<GroupSet>()[element];
    const std::vector<std::uint32_t> groups = this->Info.groups->groupsOf(set, GroupOf::Cells);
    return groups.empty() ? 0 : this->Info.groups->numberOf(groups.front());
  }

  /** A facet is written once for each of its groups. */
  void writeFacets()
  {
    const std::int64_t count =
      this->Info.groups ? this->Info.groups->memberships(GroupOf::Facets) : 0;
    if (count == 0)
    {
      return;
    }
    this->Out << (this->Info.cellType == CellType::Tetrahedron ? "Triangles\n" : "Edges\n") << count
              << '\n';
    this->Info.groups->forEach(GroupOf::Facets,
      [this](std::span<const std::int64_t> corners, GroupSet set)
      {
        for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Facets))
        {
          for (const std::int64_t corner : corners)
          {
            this->Out << corner + 1 << ' ';
          }
          this->Out << this->Info.groups->numberOf(group) << '\n';
        }
      });
  }

  /** Groups have only numbers in the file. */
  void noteGroups(WriteNotes& notes) const
  {
    if (!this->Info.groups)
    {
      return;
    }
    std::string names;
    const std::vector<Group>& groups = this->Info.groups->groups().groups;
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      if (!groups[g].name.empty() && groups[g].of != GroupOf::Vertices)
      {
        names += (names.empty() ? "" : ", ") + inQuotes(groups[g].name) + " is " +
                 std::to_string(this->Info.groups->numberOf(static_cast<std::uint32_t>(g)));
      }
    }
    if (!names.empty())
    {
      notes.push_back("Groups have only numbers in the file: " + names + '.');
    }
    if (this->Info.groups->memberships(GroupOf::Vertices) > 0)
    {
      notes.emplace_back("Groups of vertices are left out.");
    }
  }

  void beginSection()
  {
    if (this->Info.cellType == CellType::Tetrahedron)
    {
      this->Out << "Tetrahedra\n" << this->Info.elements << '\n';
    }
    else if (this->WritesQuadrilaterals)
    {
      this->Out << "Quadrilaterals\n" << this->Info.quadrilaterals << '\n';
    }
    else
    {
      this->Out << "Triangles\n" << this->Triangles << '\n';
    }
  }

  TextOutput Out;
  const MeshFileInfo Info;
  PlacedColumns Columns;
  std::ptrdiff_t VertexReferences, References, Sets;
  std::int64_t Triangles;
  bool WritesQuadrilaterals; ///< otherwise, of a surface, the triangles
};

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

bool isMedit(std::string_view start)
{
  return textAfterComments(start).starts_with("MeshVersionFormatted");
}

constexpr FileSuffix MeditSuffixes[] = { { ".mesh", true, true, FileForm::Text } };

} // namespace

const Format MeditFormat{
  .name = "Medit",
  .suffixes = MeditSuffixes,
  .description = "text",
  .cells = "triangles, quadrilaterals, tetrahedra, hexahedra, prisms, pyramids",
  .holdsGroups = true,
  .hasMagic = isMedit,
  .parse = parseWith<importMedit>,
  .typicalBytes = { 200, 4 },
  .bytes = bytesOfMedit,
  .writer = makeWriter<MeditWriter>,
  .maxCorners = 4,
};

} // namespace smg
