// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/GmshNodes.h"
#include "IO/Import/TextScanner.h"

#include <array>
#include <string>

namespace smg
{

namespace
{

/** Element types of Gmsh that become cells, by their corners; the rest of their nodes is ignored.
 */
enum class Shape
{
  None,
  Triangle,
  Quadrilateral,
  Tetrahedron,
  OtherVolume
};

Shape shapeOf(std::int64_t type)
{
  switch (type)
  {
    case 2:
    case 9:
      return Shape::Triangle;
    case 3:
    case 10:
    case 16:
      return Shape::Quadrilateral;
    case 4:
    case 11:
      return Shape::Tetrahedron;
    case 5:
    case 6:
    case 7:
    case 12:
    case 13:
    case 14:
    case 17:
    case 18:
    case 19:
      return Shape::OtherVolume;
    default:
      return Shape::None;
  }
}

/** Reads the sections of a Gmsh file. */
class GmshReader
{
public:
  GmshReader(InputFile& file, const ImportOptions& options)
    : File(file)
    , Options(options)
    , Scanner(file)
  {
  }

  IndexedMesh read()
  {
    while (!this->Scanner.atEnd())
    {
      const std::string section(this->Scanner.tokenInLine());
      if (section == "$MeshFormat")
      {
        this->readFormat();
      }
      else if (section == "$Nodes")
      {
        this->Version4 ? this->readNodeBlocks() : this->readNodes();
      }
      else if (section == "$Elements")
      {
        this->Version4 ? this->readElementBlocks() : this->readElements();
      }
      else if (section.empty() || section[0] != '$')
      {
        this->Scanner.fail(inQuotes(section) + " stands where a section should begin");
      }
      this->skipToEnd("$End" + section.substr(1));
    }
    this->Cells.finish(this->Mesh);
    return std::move(this->Mesh);
  }

private:
  void readFormat()
  {
    const double version = this->Scanner.number("the version");
    this->Version4 = version >= 4.1 && version < 5.0;
    if (!this->Version4 && (version < 2.0 || version >= 3.0))
    {
      this->Scanner.fail("this version of the format is not read: save it as 2.2 or 4.1");
    }
    if (this->Scanner.integer("the kind of file") != 0)
    {
      this->Scanner.fail("binary .msh files are not read: save it as text");
    }
  }

  /** Passes the rest of a section. */
  void skipToEnd(const std::string& end)
  {
    while (this->Scanner.peek() != end)
    {
      if (this->Scanner.atEnd())
      {
        this->Scanner.fail("the file is truncated: " + end + " is missing");
      }
      this->Scanner.skipLine();
    }
    this->Scanner.token();
  }

  void begin(std::int64_t nodes)
  {
    if (this->Nodes.count() > 0)
    {
      this->Scanner.fail("there are two sections $Nodes");
    }
    this->Mesh.positions.reserve(static_cast<std::size_t>(nodes) * 3);
  }

  void addTag(std::int64_t tag)
  {
    if (!this->Nodes.add(tag))
    {
      this->Scanner.fail("there are two nodes " + std::to_string(tag));
    }
  }

  void addPoint()
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Mesh.positions.push_back(this->Scanner.number("a coordinate of a node"));
    }
  }

  void readNodes()
  {
    const std::int64_t nodes = this->Scanner.count("the number of nodes", 8);
    this->begin(nodes);
    for (std::int64_t i = 0; i < nodes; ++i)
    {
      this->addTag(this->Scanner.integer("the tag of a node"));
      this->addPoint();
      this->Scanner.skipLine();
    }
  }

  void readNodeBlocks()
  {
    const std::int64_t blocks = this->Scanner.count("the number of blocks", 8);
    this->begin(this->Scanner.count("the number of nodes", 8));
    this->Scanner.skipLine();
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      this->Scanner.integer("the dimension of an entity");
      this->Scanner.integer("the tag of an entity");
      this->Scanner.integer("whether there are parameters");
      const std::int64_t nodes = this->Scanner.count("the number of nodes of a block", 8);
      for (std::int64_t i = 0; i < nodes; ++i)
      {
        this->addTag(this->Scanner.integer("the tag of a node"));
      }
      for (std::int64_t i = 0; i < nodes; ++i)
      {
        this->addPoint();
        this->Scanner.skipLine();
      }
    }
  }

  void checkMemory(std::int64_t elements)
  {
    MeshSizes sizes;
    sizes.vertices = this->Mesh.vertices();
    sizes.cells = elements;
    sizes.corners = 4;
    this->Options.budget.check(this->File.path(), sizes);
  }

  void readElements()
  {
    const std::int64_t elements = this->Scanner.count("the number of elements", 6);
    this->checkMemory(elements);
    for (std::int64_t i = 0; i < elements; ++i)
    {
      this->Scanner.integer("the tag of an element");
      const std::int64_t type = this->Scanner.integer("the type of an element");
      const std::int64_t tags = this->Scanner.count("the number of tags", 2);
      for (std::int64_t k = 0; k < tags; ++k)
      {
        this->Scanner.integer("a tag of an element");
      }
      this->readElement(type);
    }
  }

  void readElementBlocks()
  {
    const std::int64_t blocks = this->Scanner.count("the number of blocks", 8);
    this->checkMemory(this->Scanner.count("the number of elements", 4));
    this->Scanner.skipLine();
    for (std::int64_t block = 0; block < blocks; ++block)
    {
      this->Scanner.integer("the dimension of an entity");
      this->Scanner.integer("the tag of an entity");
      const std::int64_t type = this->Scanner.integer("the type of the elements");
      const std::int64_t elements = this->Scanner.count("the number of elements of a block", 4);
      for (std::int64_t i = 0; i < elements; ++i)
      {
        this->Scanner.integer("the tag of an element");
        this->readElement(type);
      }
    }
  }

  /** The nodes of an element, the rest of its line. */
  void readElement(std::int64_t type)
  {
    const Shape shape = shapeOf(type);
    std::array<std::int64_t, 4> corners{};
    const std::size_t count = shape == Shape::Triangle ? 3 : 4;
    if (shape == Shape::OtherVolume)
    {
      this->Scanner.fail("the mesh has elements of type " + std::to_string(type) +
                         " (hexahedra, prisms or pyramids): cut them into tetrahedra first");
    }
    if (shape == Shape::None)
    {
      this->Cells.dropped();
      this->Scanner.skipLine();
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::int64_t tag = this->Scanner.integer("a node of an element");
      corners[k] = this->Nodes.find(tag);
      if (corners[k] < 0)
      {
        this->Scanner.fail(
          "the element names node " + std::to_string(tag) + ", which is not there");
      }
    }
    this->Scanner.skipLine();
    if (shape == Shape::Triangle)
    {
      this->Cells.triangle(corners[0], corners[1], corners[2]);
    }
    else if (shape == Shape::Quadrilateral)
    {
      this->Cells.polygon(corners);
    }
    else
    {
      this->Cells.tetrahedron(corners[0], corners[1], corners[2], corners[3]);
    }
  }

  InputFile& File;
  const ImportOptions& Options;
  TextScanner Scanner;
  IndexedMesh Mesh;
  CellCollector Cells;
  GmshNodes Nodes;
  bool Version4 = false;
};

} // namespace

IndexedMesh importGmsh(InputFile& file, const ImportOptions& options)
{
  return GmshReader(file, options).read();
}

} // namespace smg
