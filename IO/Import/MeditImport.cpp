// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Import/CellCollector.h"
#include "IO/Import/Formats.h"
#include "IO/Import/TextScanner.h"

#include <array>
#include <cctype>
#include <cstring>
#include <string>

namespace smg
{

namespace
{

/** Reads the sections of a Medit file. */
class MeditReader
{
public:
  MeditReader(InputFile& file, const ImportOptions& options)
    : File(file)
    , Options(options)
    , Scanner(file, '#')
  {
  }

  IndexedMesh read()
  {
    this->findSizes();
    while (!this->Scanner.atEnd())
    {
      const std::string keyword(this->Scanner.token());
      if (keyword == "End")
      {
        break;
      }
      this->readSection(keyword);
    }
    if (this->LargestCorner > this->Mesh.vertices())
    {
      this->Scanner.failAt(
        this->LargestLine, "the element names vertex " + std::to_string(this->LargestCorner) +
                             ", but the file has " + std::to_string(this->Mesh.vertices()));
    }
    this->finish();
    return std::move(this->Mesh);
  }

private:
  /** Looks the counts of the sections up, for the memory the mesh will take. */
  void findSizes()
  {
    MeshSizes triangles;
    triangles.vertexColumnBytes = triangles.cellColumnBytes = sizeof(std::int64_t);
    MeshSizes tetrahedra = triangles;
    TextScanner scanner(this->File, '#');
    while (!scanner.atEnd())
    {
      const std::string_view token = scanner.tokenInLine();
      if (token == "Vertices")
      {
        triangles.vertices = tetrahedra.vertices = scanner.count("the number of vertices", 4);
      }
      else if (token == "Triangles")
      {
        triangles.cells = scanner.count("the number of triangles", 6);
      }
      else if (token == "Tetrahedra")
      {
        tetrahedra.cells = scanner.count("the number of tetrahedra", 8);
        tetrahedra.corners = 4;
      }
      scanner.skipLine();
    }
    this->File.rewind();
    this->Options.budget.check(this->File.path(), tetrahedra.cells > 0 ? tetrahedra : triangles);
  }

  void readSection(const std::string& keyword)
  {
    if (keyword == "MeshVersionFormatted")
    {
      this->Scanner.integer("the version");
    }
    else if (keyword == "Dimension")
    {
      this->Dimension = this->Scanner.integer("the dimension");
      if (this->Dimension != 2 && this->Dimension != 3)
      {
        this->Scanner.fail("the dimension must be 2 or 3");
      }
    }
    else if (keyword == "Vertices")
    {
      this->readVertices();
    }
    else if (keyword == "Triangles" || keyword == "Quadrilaterals" || keyword == "Tetrahedra")
    {
      this->readCells(keyword[0] == 'T' && keyword[1] == 'r' ? 3 : 4, keyword[0] == 'Q');
    }
    else if (keyword == "Hexahedra" || keyword == "Prisms" || keyword == "Pyramids")
    {
      if (this->Scanner.count("the number of elements", 2) > 0)
      {
        this->Scanner.fail("the mesh has " + keyword + ": cut them into tetrahedra first");
      }
    }
    else if (std::isalpha(static_cast<unsigned char>(keyword[0])))
    {
      this->skipSection();
    }
    else
    {
      this->Scanner.fail(inQuotes(keyword) + " stands where a keyword should be: a section is "
                                             "longer than its number of entries");
    }
  }

  /** Passes the numbers of a section that is of no interest. */
  void skipSection()
  {
    std::string_view next = this->Scanner.peek();
    while (!next.empty() && !std::isalpha(static_cast<unsigned char>(next[0])))
    {
      this->Scanner.skipLine();
      next = this->Scanner.peek();
    }
  }

  void readVertices()
  {
    if (!this->Mesh.positions.empty())
    {
      this->Scanner.fail("there are two sections 'Vertices'");
    }
    const std::int64_t count = this->Scanner.count("the number of vertices", 4);
    this->Mesh.positions.reserve(static_cast<std::size_t>(count) * 3);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (std::int64_t axis = 0; axis < 3; ++axis)
      {
        this->Mesh.positions.push_back(
          axis < this->Dimension ? this->Scanner.number("a coordinate of a vertex") : 0.0);
      }
      this->VertexReferences.push_back(this->reference());
    }
  }

  void readCells(int corners, bool quadrilateral)
  {
    const std::int64_t count =
      this->Scanner.count("the number of elements", 2 * static_cast<std::size_t>(corners));
    std::array<std::int64_t, 4> cell{};
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int k = 0; k < corners; ++k)
      {
        cell[static_cast<std::size_t>(k)] = this->corner();
      }
      this->CellReferences.push_back(this->reference());
      if (corners == 3)
      {
        this->Cells.triangle(cell[0], cell[1], cell[2]);
      }
      else if (quadrilateral)
      {
        this->Cells.polygon(cell);
      }
      else
      {
        this->Cells.tetrahedron(cell[0], cell[1], cell[2], cell[3]);
      }
    }
  }

  std::int64_t corner()
  {
    const std::int64_t number = this->Scanner.integer("a vertex of an element");
    if (number < 1)
    {
      this->Scanner.fail(
        "an element names vertex " + std::to_string(number) + ", they count from 1");
    }
    if (number > this->LargestCorner)
    {
      this->LargestCorner = number;
      this->LargestLine = this->Scanner.line();
    }
    return number - 1;
  }

  /** The label at the end of an entry's line; some writers leave it out. */
  std::int64_t reference()
  {
    const std::string_view token = this->Scanner.tokenInLine();
    const std::int64_t label = token.empty() ? 0 : this->Scanner.toInteger(token, "a label");
    this->Labelled = this->Labelled || label != 0;
    return label;
  }

  void finish()
  {
    std::vector<Column> cellColumns;
    if (this->Labelled)
    {
      this->Mesh.vertexColumns.push_back(labels(this->VertexReferences));
      cellColumns.push_back(labels(this->CellReferences));
    }
    this->Cells.finish(this->Mesh, std::move(cellColumns));
  }

  static Column labels(const std::vector<std::int64_t>& values)
  {
    Column column{ { "Reference", ScalarType::Int64, 1 }, {} };
    column.resize(values.size());
    if (!values.empty())
    {
      std::memcpy(column.bytes.data(), values.data(), column.bytes.size());
    }
    return column;
  }

  InputFile& File;
  const ImportOptions& Options;
  TextScanner Scanner;
  IndexedMesh Mesh;
  CellCollector Cells;
  std::vector<std::int64_t> VertexReferences, CellReferences;
  bool Labelled = false;
  std::int64_t Dimension = 3;
  std::int64_t LargestCorner = 0;
  std::int64_t LargestLine = 0;
};

} // namespace

IndexedMesh importMedit(InputFile& file, const ImportOptions& options)
{
  return MeditReader(file, options).read();
}

} // namespace smg
