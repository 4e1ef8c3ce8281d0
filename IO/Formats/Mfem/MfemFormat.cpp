// SPDX-License-Identifier: BSD-3-Clause
#include "IO/External/BucketFile.h"
#include "IO/Files/FileNames.h"
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
#include <vector>

namespace smg
{

namespace
{

/** A geometry of MFEM, by its number: its dimension and corners. */
struct MfemGeometry
{
  int dimension;
  std::size_t corners;
};
constexpr std::array<MfemGeometry, 8> MfemGeometries{ { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 2, 4 },
  { 3, 4 }, { 3, 8 }, { 3, 6 }, { 3, 5 } } };

/**
 * Reads the sections of a mesh of MFEM, versions 1.0 to 1.3: elements and elements of the boundary
 * with their attributes, which are groups, then perhaps the names of sets of attributes, then the
 * vertices. A curved mesh has its nodes instead of coordinates: the first are the vertices.
 */
class MfemReader
{
public:
  MfemReader(InputFile& file, RawMeshBuilder& builder)
    : Scanner(file, '#', &builder.workspace())
    , Builder(builder)
    , References(builder, ColumnOf::Elements, ReferenceName, 1)
  {
  }

  void read()
  {
    this->Scanner.locateErrors(
      [this]
      {
        this->readVersion();
        for (std::string section(this->Scanner.token()); !section.empty() && this->isGoingOn;
             section = this->Scanner.token())
        {
          this->readSection(section);
        }
        this->Builder.checkCorners();
      });
    this->References.finish();
  }

private:
  void readVersion()
  {
    this->Scanner.skipLine(); // checked by isMfem(), perhaps after a comment
    this->Builder.numberVertices(0);
  }

  void readSection(const std::string& section)
  {
    if (section == "dimension")
    {
      this->Dimension = static_cast<int>(this->Scanner.integer("the dimension"));
      if (this->Dimension != 2 && this->Dimension != 3)
      {
        this->Scanner.fail("the dimension must be 2 or 3");
      }
    }
    else if (section == "elements" || section == "boundary")
    {
      this->readElements(section == "boundary");
    }
    else if (section == "attribute_sets" || section == "bdr_attribute_sets")
    {
      this->readSets(this->Dimension - (section == "attribute_sets" ? 0 : 1));
    }
    else if (section == "vertices")
    {
      this->readVertices();
    }
    else if (section == "nodes")
    {
      this->readNodes();
    }
    else if (section == "mfem_mesh_end" || section == "mfem_serial_mesh_end")
    {
      this->isGoingOn = false;
    }
    else
    {
      this->Scanner.fail("the section " + inQuotes(section) +
                         " is not read: save the mesh in the format 'MFEM mesh v1.0'");
    }
  }

  void readElements(bool areOfBoundary)
  {
    const std::int64_t count = this->Scanner.count("the number of elements", 6);
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t attribute = this->Scanner.integer("the attribute of an element");
      const std::int64_t type = this->Scanner.integer("the geometry of an element");
      if (type < 0 || type >= std::ssize(MfemGeometries))
      {
        this->Scanner.fail("the geometry " + std::to_string(type) + " is not known: 0 to 7 are");
      }
      const MfemGeometry& geometry = MfemGeometries[static_cast<std::size_t>(type)];
      std::array<std::int64_t, 8> storage{};
      const std::span<std::int64_t> corners = std::span(storage).first(geometry.corners);
      for (std::int64_t& corner : corners)
      {
        corner = this->Scanner.integer("a vertex of an element");
      }
      this->Builder.setLine(this->Scanner.line());
      const GroupSet set = this->Builder.groups().numbered(geometry.dimension, attribute);
      if (areOfBoundary)
      {
        this->Builder.grouped(geometry.dimension, corners, set);
        continue;
      }
      this->Builder.setGroups(set);
      this->Builder.element(geometry.dimension, corners);
      this->References.add(attribute);
    }
  }

  /** Lines as `"name" 1 2 3`: sets of attributes. */
  void readSets(int dimension)
  {
    const std::int64_t count = this->Scanner.count("the number of sets", 4);
    this->Scanner.skipLine();
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::string_view line = trimmed(this->Scanner.restOfLine().value_or(""));
      const std::size_t end = line.find('"', 1);
      if (!line.starts_with('"') || end == std::string_view::npos)
      {
        this->Scanner.fail("the name of a set of attributes should stand here, in quotation marks");
      }
      const std::string name(line.substr(1, end - 1));
      std::string_view rest = trimmed(line.substr(end + 1));
      while (!rest.empty())
      {
        const std::string_view word = rest.substr(0, rest.find_first_of(Blanks));
        this->Builder.groups().include(
          dimension, this->Scanner.toInteger(word, "an attribute"), name);
        rest = trimmed(rest.substr(word.size()));
      }
      this->Scanner.skipLine();
    }
  }

  void readVertices()
  {
    if (this->Builder.vertices() > 0)
    {
      this->Scanner.fail("there are two sections of vertices");
    }
    this->Vertices = this->Scanner.count("the number of vertices", 2);
    // Of a curved mesh, the nodes follow.
    if (this->Scanner.peek() == "nodes")
    {
      return;
    }
    const std::size_t axes = this->axes("the dimension of space");
    for (std::int64_t i = 0; i < this->Vertices; ++i)
    {
      std::array<double, 3> point{};
      for (double& coordinate : std::span(point).first(axes))
      {
        coordinate = this->Scanner.number("a coordinate of a vertex");
      }
      this->Builder.vertex(point[0], point[1], point[2]);
    }
  }

  std::size_t axes(const char* what)
  {
    const std::int64_t axes = this->Scanner.integer(what);
    if (axes < 2 || axes > 3)
    {
      this->Scanner.fail(std::string(what) + " must be 2 or 3");
    }
    return static_cast<std::size_t>(axes);
  }

  void expect(std::string_view word)
  {
    if (const std::string_view token = this->Scanner.token(); token != word)
    {
      this->Scanner.fail(
        inQuotes(token) + " stands where " + inQuotes(std::string(word)) + " should be");
    }
  }

  /** The nodes of a continuous space, whose degrees of freedom begin with the vertices. */
  void readNodes()
  {
    if (this->Builder.vertices() > 0)
    {
      return; // straight ones have come
    }
    this->expect("FiniteElementSpace");
    this->expect("FiniteElementCollection:");
    const std::string space(this->Scanner.token());
    const bool isContinuous =
      space.starts_with("H1") || space == "Linear" || space == "Quadratic" || space == "Cubic";
    if (!isContinuous)
    {
      this->Scanner.fail("the nodes are in the space " + inQuotes(space) +
                         ", which is not continuous, and are not read: save a straight mesh");
    }
    this->expect("VDim:");
    const std::size_t axes = this->axes("the dimension of the nodes");
    this->expect("Ordering:");
    const bool isByAxis = this->Scanner.integer("the order of the nodes") == 0;
    isByAxis ? this->readNodesByAxis(axes) : this->readNodesByNode(axes);
    if (this->Builder.elements() > 0)
    {
      this->Builder.note("The mesh is curved: its elements become straight between vertices.");
    }
    this->isGoingOn = false;
  }

  void readNodesByNode(std::size_t axes)
  {
    for (std::int64_t i = 0; i < this->Vertices; ++i)
    {
      std::array<double, 3> point{};
      for (double& coordinate : std::span(point).first(axes))
      {
        coordinate = this->Scanner.number("a coordinate of a node");
      }
      this->Builder.vertex(point[0], point[1], point[2]);
    }
  }

  /** All x, then all y, then all z: where each begins is known when all are counted. */
  void readNodesByAxis(std::size_t axes)
  {
    RecordFile<double> numbers(this->Builder.workspace());
    while (
      !this->Scanner.atEnd() && !std::isalpha(static_cast<unsigned char>(this->Scanner.peek()[0])))
    {
      numbers.put(this->Scanner.number("a coordinate of a node"));
    }
    numbers.close();
    const std::int64_t nodes = numbers.size() / static_cast<std::int64_t>(axes);
    if (nodes < this->Vertices)
    {
      this->Scanner.fail("there are " + std::to_string(nodes) + " nodes, fewer than the " +
                         std::to_string(this->Vertices) + " vertices");
    }
    std::vector<RecordFile<double>> ofAxes;
    RecordFile<double>::Reader all(numbers);
    double number = 0;
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      RecordFile<double>& own = ofAxes.emplace_back(this->Builder.workspace());
      for (std::int64_t i = 0; i < nodes && all.next(number); ++i)
      {
        if (i < this->Vertices)
        {
          own.put(number);
        }
      }
      own.close();
    }
    std::vector<RecordFile<double>::Reader> readers(ofAxes.begin(), ofAxes.end());
    for (std::int64_t i = 0; i < this->Vertices; ++i)
    {
      std::array<double, 3> point{};
      for (std::size_t axis = 0; axis < axes; ++axis)
      {
        readers[axis].next(point[axis]);
      }
      this->Builder.vertex(point[0], point[1], point[2]);
    }
  }

  TextScanner Scanner;
  RawMeshBuilder& Builder;
  LabelColumn References;
  int Dimension = 3;
  std::int64_t Vertices = 0;
  bool isGoingOn = true;
};

void importMfem(InputFile& file, RawMeshBuilder& builder)
{
  MfemReader(file, builder).read();
}

bool isMfem(std::string_view start)
{
  return textAfterComments(start).starts_with("MFEM mesh v1.");
}

/** The suffix `.mesh` is that of Medit, which has a signature, too. */
constexpr FileSuffix MfemSuffixes[] = { { ".mfem", true, true, FileForm::Text } };

} // namespace

const Format MfemFormat{
  .name = "MFEM",
  .suffixes = MfemSuffixes,
  .description =
    "versions 1.0 to 1.3, straight or curved; usually with the suffix `.mesh`, as Medit",
  .cells = "triangles, quadrilaterals, tetrahedra, hexahedra, prisms, pyramids",
  .hasMagic = isMfem,
  .parse = parseWith<importMfem>,
  .typicalBytes = { 200, 4 },
};

} // namespace smg
