// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Medit/MeditSections.h"
#include "IO/Formats/Medit/WriteMedit.h"
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
  .groups = GroupForm::Elements,
  .hasMagic = isMedit,
  .parse = parseWith<importMedit>,
  .typicalBytes = { 200, 4 },
  .bytes = bytesOfMedit,
  .writer = makeMeditWriter,
  .maxCorners = 4,
};

} // namespace smg
