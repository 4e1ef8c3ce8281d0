// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace smg
{

namespace
{

/** Corners of elements of Netgen in the order of this library, whose tetrahedra are turned over. */
std::span<const std::uint8_t> netgenOrder(std::size_t corners)
{
  static constexpr std::array<std::uint8_t, 4> Tetrahedron{ 0, 2, 1, 3 };
  static constexpr std::array<std::uint8_t, 5> Pyramid{ 0, 3, 2, 1, 4 };
  static constexpr std::array<std::uint8_t, 6> Prism{ 0, 2, 1, 3, 5, 4 };
  static constexpr std::array<std::uint8_t, 8> Hexahedron{ 0, 3, 2, 1, 4, 7, 6, 5 };
  switch (corners)
  {
    case 4:
      return Tetrahedron;
    case 5:
      return Pyramid;
    case 6:
      return Prism;
    default:
      return Hexahedron;
  }
}

/** Reads the sections of a mesh of Netgen. Elements come before the points; surface elements have
 * the number of their boundary condition, solids that of their material, and both may have names.
 */
class NetgenReader
{
public:
  NetgenReader(InputFile& file, RawMeshBuilder& builder)
    : Scanner(file, '#', &builder.workspace())
    , Builder(builder)
    , References(builder, ColumnOf::Elements, ReferenceName, 1)
  {
  }

  void read()
  {
    this->Builder.numberVertices(1);
    this->Scanner.locateErrors(
      [this]
      {
        while (!this->Scanner.atEnd())
        {
          const std::string section(this->Scanner.token());
          if (section == "endmesh")
          {
            break;
          }
          this->readSection(section);
        }
        this->Builder.checkCorners();
      });
    this->References.finish();
  }

private:
  void readSection(const std::string& section)
  {
    if (section == "dimension")
    {
      this->Dimension = this->Scanner.integer("the dimension");
      if (this->Dimension != 2 && this->Dimension != 3)
      {
        this->Scanner.fail("the dimension must be 2 or 3");
      }
    }
    else if (section.starts_with("surfaceelements"))
    {
      this->readElements(2);
    }
    else if (section == "volumeelements")
    {
      this->readElements(3);
    }
    else if (section == "edgesegmentsgi2" && this->Dimension == 2)
    {
      this->readEdges();
    }
    else if (section == "points")
    {
      this->readPoints();
    }
    else if (section == "materials" || section == "bcnames")
    {
      const int ofCells = static_cast<int>(this->Dimension);
      this->readNames(section == "materials" ? ofCells : ofCells - 1);
    }
    // The lines of other sections are passed: the words of none of them are names of sections.
    else if (section != "mesh3d")
    {
      this->Scanner.skipLine();
    }
  }

  GroupSet groupOf(int dimension, std::int64_t number)
  {
    return number == 0 ? GroupTable::None : this->Builder.groups().numbered(dimension, number);
  }

  /** Surface elements with the numbers of the surface, the boundary condition and the domains on
   * both sides; solids with that of the material. */
  void readElements(int dimension)
  {
    const std::int64_t count = this->Scanner.count("the number of elements", 8);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const bool isSolid = dimension == 3;
      if (!isSolid)
      {
        this->Scanner.integer("the number of a surface");
      }
      const std::int64_t number = this->Scanner.integer("the number of a condition or material");
      for (int domain = 0; domain < 2 && !isSolid; ++domain)
      {
        this->Scanner.integer("the number of a domain");
      }
      const std::int64_t nodes = this->Scanner.integer("the number of points of an element");
      const std::size_t corners = cornersOfNodes(dimension, nodes);
      std::array<std::int64_t, 8> read{}, ordered{};
      for (std::int64_t k = 0; k < nodes; ++k)
      {
        const std::int64_t node = this->Scanner.integer("a point of an element");
        if (k < static_cast<std::int64_t>(corners))
        {
          read[static_cast<std::size_t>(k)] = node;
        }
      }
      for (std::size_t k = 0; k < corners; ++k)
      {
        ordered[k] = isSolid ? read[netgenOrder(corners)[k]] : read[k];
      }
      this->Builder.setLine(this->Scanner.line());
      this->Scanner.skipLine(); // parameters on the geometry may follow
      this->Builder.setGroups(this->groupOf(dimension, number));
      this->Builder.element(
        dimension, std::span(ordered).first(corners), nodes > static_cast<std::int64_t>(corners));
      this->References.add(number);
    }
  }

  std::size_t cornersOfNodes(int dimension, std::int64_t nodes) const
  {
    const auto isOneOf = [nodes](std::initializer_list<std::int64_t> counts)
    { return std::ranges::find(counts, nodes) != counts.end(); };
    const std::size_t corners = dimension == 2           ? (isOneOf({ 3, 6 })    ? 3
                                                             : isOneOf({ 4, 8 }) ? 4
                                                                                 : 0)
                                : isOneOf({ 4, 10 })     ? 4
                                : isOneOf({ 5, 13 })     ? 5
                                : isOneOf({ 6, 12, 15 }) ? 6
                                : isOneOf({ 8, 20 })     ? 8
                                                         : 0;
    if (corners == 0)
    {
      this->Scanner.fail("elements of " + std::to_string(nodes) + " points are not read");
    }
    return corners;
  }

  /** Edges of plane meshes, with the number of their boundary condition. */
  void readEdges()
  {
    const std::int64_t count = this->Scanner.count("the number of edges", 8);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t number = this->Scanner.integer("the number of a condition");
      this->Scanner.integer("the second number of an edge");
      const std::int64_t a = this->Scanner.integer("a point of an edge");
      const std::int64_t b = this->Scanner.integer("a point of an edge");
      this->Builder.setLine(this->Scanner.line());
      this->Scanner.skipLine();
      this->Builder.grouped(1, std::array{ a, b }, this->groupOf(1, number));
    }
  }

  void readPoints()
  {
    if (this->Builder.vertices() > 0)
    {
      this->Scanner.fail("there are two sections of points");
    }
    const std::int64_t count = this->Scanner.count("the number of points", 6);
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::array<double, 3> point{};
      for (double& coordinate : point)
      {
        coordinate = this->Scanner.number("a coordinate of a point");
      }
      this->Builder.vertex(point[0], point[1], point[2]);
    }
  }

  void readNames(int dimension)
  {
    const std::int64_t count = this->Scanner.count("the number of names", 2);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t number = this->Scanner.integer("the number of a name");
      std::string_view name = trimmed(this->Scanner.restOfLine().value_or(""));
      name = name.substr(0, name.find_last_not_of(Blanks) + 1);
      if (!name.empty() && name != "default")
      {
        this->Builder.groups().setName(dimension, number, std::string(name));
      }
      this->Scanner.skipLine();
    }
  }

  TextScanner Scanner;
  RawMeshBuilder& Builder;
  LabelColumn References;
  std::int64_t Dimension = 3;
};

void importNetgen(InputFile& file, RawMeshBuilder& builder)
{
  NetgenReader(file, builder).read();
}

bool isNetgen(std::string_view start)
{
  return textAfterComments(start).starts_with("mesh3d");
}

constexpr FileSuffix NetgenSuffixes[] = { { ".vol", true, true, FileForm::Text } };

} // namespace

const Format NetgenFormat{
  .name = "Netgen",
  .suffixes = NetgenSuffixes,
  .description = "text",
  .cells = "triangles, quadrilaterals, tetrahedra, hexahedra, prisms, pyramids; the corners of "
           "higher-order ones",
  .hasMagic = isNetgen,
  .parse = parseWith<importNetgen>,
  .typicalBytes = { 250, 4 },
};

} // namespace smg
