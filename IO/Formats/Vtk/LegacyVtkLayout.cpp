// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Formats/Vtk/LegacyVtkScanner.h"
#include "IO/Formats/Vtk/VtkAttributes.h"
#include "IO/Formats/Vtk/VtkLayout.h"
#include "IO/Mesh/GroupsJson.h"

#include <limits>
#include <string>
#include <utility>

namespace smg
{

namespace
{

class LegacyLayoutReader
{
public:
  explicit LegacyLayoutReader(InputFile& file)
    : File(file)
    , Scanner(file)
  {
  }

  VtkLayout read()
  {
    this->Scanner.readTitle();
    this->readKind();
    for (std::string word = this->Scanner.keyword(); !word.empty(); word = this->Scanner.keyword())
    {
      if (!this->readGeometry(word) && !this->readAttribute(word))
      {
        this->Scanner.fail(inQuotes(word) +
                           " is not a keyword of the format: the file is damaged, or "
                           "a count before is wrong");
      }
    }
    this->check();
    VtkLayout layout;
    layout.files.emplace_back(this->File);
    layout.pieces.push_back(std::move(this->Piece));
    layout.otherArrays = std::move(this->OtherArrays);
    layout.repeatedArrays = std::move(this->RepeatedArrays);
    layout.fields = std::move(this->Fields);
    layout.groupsText = std::move(this->GroupsText);
    return layout;
  }

private:
  void readKind()
  {
    std::string word = this->Scanner.keyword();
    while (word == "FIELD")
    {
      this->readField(nullptr, -1);
      word = this->Scanner.keyword();
    }
    const std::string kind = this->Scanner.keyword();
    this->IsGrid = kind == "UNSTRUCTURED_GRID";
    if (word != "DATASET" || (!this->IsGrid && kind != "POLYDATA"))
    {
      this->Scanner.fail("the file is neither polygonal data nor an unstructured grid of VTK, "
                         "which are the kinds that hold meshes");
    }
    using namespace VtkCellTypes;
    for (const int type : { PolyVertex, PolyLine, Polygon, VtkCellTypes::TriangleStrip })
    {
      this->Piece.lists.emplace_back().type = type;
    }
    this->Piece.lists.resize(this->IsGrid ? 1 : 4);
  }

  bool readGeometry(const std::string& word)
  {
    static constexpr const char* Lists[] = { "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS" };
    for (std::size_t i = 0; i < 4 && !this->IsGrid; ++i)
    {
      if (word == Lists[i])
      {
        this->readList(this->Piece.lists[i], Lists[i]);
        return true;
      }
    }
    if (word == "CELLS" && this->IsGrid)
    {
      this->readList(this->Piece.lists.front(), "CELLS");
    }
    else if (word == "CELL_TYPES" && this->IsGrid)
    {
      const std::int64_t cells = this->Scanner.count("the number of cells");
      this->Piece.lists.front().types = this->Scanner.array("CELL_TYPES", "int", 1, cells);
    }
    else if (word == "POINTS")
    {
      this->Piece.points = this->Scanner.count("the number of points");
      const std::string type = this->Scanner.word();
      this->Piece.positions =
        this->Scanner.array("POINTS", type, 3, this->product(this->Piece.points, 3));
    }
    else
    {
      return false;
    }
    return true;
  }

  void readList(VtkCellList& list, const char* name)
  {
    if (list.points)
    {
      this->Scanner.fail(inQuotes(name) + " comes a second time");
    }
    const std::int64_t first = this->Scanner.count("the number of cells");
    const std::int64_t second = this->Scanner.count("the size of the list of cells");
    if (this->Scanner.majorVersion() < 5)
    {
      if (first > second)
      {
        this->Scanner.fail("a list of " + std::to_string(second) + " numbers cannot hold " +
                           std::to_string(first) + " cells");
      }
      list.cells = first;
      list.points = this->Scanner.array(name, "int", 1, second);
      return;
    }
    list.cells = first > 0 ? first - 1 : 0;
    if (first == 0)
    {
      return;
    }
    list.offsets = this->readPart("OFFSETS", first);
    list.points = this->readPart("CONNECTIVITY", second);
  }

  VtkArray readPart(const char* name, std::int64_t values)
  {
    const std::string word = this->Scanner.keyword();
    if (word != name)
    {
      this->Scanner.fail(inQuotes(word) + " stands where " + name + " should be");
    }
    const std::string type = this->Scanner.word();
    return this->Scanner.array(name, type, 1, values);
  }

  bool readAttribute(const std::string& word)
  {
    if (word == "POINT_DATA" || word == "CELL_DATA")
    {
      this->OfPoints = word == "POINT_DATA";
      this->Arrays = this->OfPoints ? &this->Piece.pointArrays : &this->Piece.cellArrays;
      this->Tuples = this->Scanner.count("the number of points or cells");
      (this->OfPoints ? this->PointTuples : this->CellTuples) = this->Tuples;
      return true;
    }
    if (word == "METADATA")
    {
      this->skipMetadata();
      return true;
    }
    if (word == "FIELD")
    {
      this->readField(this->Arrays, this->Tuples);
      return true;
    }
    return this->Arrays && this->readNamed(word);
  }

  /** An attribute that begins with its name. */
  bool readNamed(const std::string& word)
  {
    static constexpr std::pair<const char*, int> Kinds[] = { { "SCALARS", 0 }, { "VECTORS", 3 },
      { "NORMALS", 3 }, { "TENSORS", 9 }, { "TENSORS6", 6 }, { "TEXTURE_COORDINATES", 0 },
      { "GLOBAL_IDS", 1 }, { "PEDIGREE_IDS", 1 }, { "EDGE_FLAGS", 1 }, { "COLOR_SCALARS", 0 },
      { "LOOKUP_TABLE", 4 } };
    for (const auto& [kind, components] : Kinds)
    {
      if (word == kind)
      {
        const std::string name = this->Scanner.name();
        this->readNamed(word, name, components);
        return true;
      }
    }
    return false;
  }

  void readNamed(const std::string& kind, const std::string& name, int components)
  {
    if (kind == "LOOKUP_TABLE")
    {
      const std::int64_t colors = this->Scanner.count("the number of colours");
      const char* const type = this->Scanner.isBinary() ? "unsigned_char" : "float";
      this->Scanner.array(name, type, components, this->product(colors, components));
      return;
    }
    if (kind == "COLOR_SCALARS")
    {
      this->readColors(name);
      return;
    }
    if (kind == "TEXTURE_COORDINATES")
    {
      components = this->components();
      this->Piece.pointTexture =
        this->OfPoints && this->Piece.pointTexture.empty() ? name : this->Piece.pointTexture;
    }
    const std::string type = this->Scanner.word();
    if (kind == "SCALARS")
    {
      components = this->scalarComponents();
    }
    if (kind == "NORMALS")
    {
      std::string& normals = this->OfPoints ? this->Piece.pointNormals : this->Piece.cellNormals;
      normals = normals.empty() ? name : normals;
    }
    if (kind == "GLOBAL_IDS" && this->OfPoints)
    {
      this->Piece.globalIds = name;
    }
    this->readArray(this->Arrays, name, type, components, this->Tuples);
  }

  /** Bytes, or where they are text numbers from 0 to 1. */
  void readColors(const std::string& name)
  {
    const int components = this->components();
    const bool binary = this->Scanner.isBinary();
    VtkArray array = this->Scanner.array(name, binary ? "unsigned_char" : "float", components,
      this->product(this->Tuples, components));
    array.columnType = ScalarType::UInt8;
    array.isFractions = !binary;
    this->keep(std::move(array), *this->Arrays);
  }

  void keep(VtkArray array, std::vector<VtkArray>& arrays)
  {
    // Their descriptions are stored in memory.
    constexpr std::size_t MaxArrays = 4096;
    if (arrays.size() == MaxArrays)
    {
      this->Scanner.fail("there are more than " + std::to_string(MaxArrays) +
                         " arrays of points or of cells, which are too many");
    }
    (this->OfPoints ? this->PointNames : this->CellNames).nameApart(array, this->RepeatedArrays);
    arrays.push_back(std::move(array));
  }

  int components()
  {
    const std::int64_t components = this->Scanner.count("the number of components");
    if (components < 1 || components > std::numeric_limits<std::int16_t>::max())
    {
      this->Scanner.fail("an array cannot have " + std::to_string(components) + " components");
    }
    return static_cast<int>(components);
  }

  /** After the type of scalars: their number of components, if given, and their colour table. */
  int scalarComponents()
  {
    const std::string next = this->Scanner.peek();
    const bool told = !next.empty() && next[0] >= '0' && next[0] <= '9';
    const int components = told ? this->components() : 1;
    if (this->Scanner.keyword() != "LOOKUP_TABLE")
    {
      this->Scanner.fail("scalars should be followed by LOOKUP_TABLE");
    }
    this->Scanner.word();
    return components;
  }

  /** Arrays with their own number of tuples: those with `tuples` are added to `arrays`. Without
   * `arrays` they are those of the mesh as a whole. */
  void readField(std::vector<VtkArray>* arrays, std::int64_t tuples)
  {
    this->Scanner.word();
    const std::int64_t count = this->Scanner.count("the number of arrays");
    for (std::int64_t i = 0; i < count; ++i)
    {
      std::string name = this->Scanner.name();
      if (name == "METADATA")
      {
        this->skipMetadata();
        name = this->Scanner.name();
      }
      if (name.empty())
      {
        this->Scanner.fail("the file ends where the name of an array should be");
      }
      if (name == "NULL_ARRAY")
      {
        continue;
      }
      const std::int64_t components = this->Scanner.count("the number of components");
      const std::int64_t own = this->Scanner.count("the number of tuples");
      const std::string type = this->Scanner.word();
      if (!arrays)
      {
        addFieldName(this->Fields, name);
      }
      const bool wanted =
        own == tuples && components > 0 && components <= std::numeric_limits<std::int16_t>::max();
      this->product(own, components);
      this->readArray(wanted ? arrays : nullptr, name, type, components, own);
    }
  }

  void readArray(std::vector<VtkArray>* arrays, const std::string& name, const std::string& type,
    std::int64_t components, std::int64_t tuples)
  {
    const std::int64_t values = this->product(tuples, components);
    const bool areBits = type == "bit", areTexts = type == "string" || type == "utf8_string";
    if (areBits || areTexts)
    {
      const bool areGroups = areTexts && !arrays && name == MeshGroupsName;
      std::string text;
      areBits ? this->Scanner.skipBits(values)
              : void(text = this->Scanner.skipTexts(values, areGroups ? MaxGroupTextBytes : 0));
      this->GroupsText = areGroups ? text : this->GroupsText;
      if (arrays && arrays == this->Arrays && this->OtherArrays.size() < MaxOtherArrays)
      {
        this->OtherArrays.insert(name);
      }
    }
    else
    {
      VtkArray array = this->Scanner.array(name, type, static_cast<int>(components), values);
      if (arrays)
      {
        this->keep(std::move(array), *arrays);
      }
    }
  }

  std::int64_t product(std::int64_t count, std::int64_t components)
  {
    std::int64_t values = 0;
    if (__builtin_mul_overflow(count, components, &values))
    {
      this->Scanner.fail("the file cannot have " + std::to_string(count) + " tuples of " +
                         std::to_string(components) + " numbers: a count is wrong");
    }
    return values;
  }

  /** Up to the next empty line. */
  void skipMetadata()
  {
    this->Scanner.line();
    while (this->Scanner.offset() < this->File.size())
    {
      const std::string line = this->Scanner.line();
      if (line.empty() || line == "\r")
      {
        return;
      }
    }
  }

  /** Checks that all sections exist and are consistent. */
  void check()
  {
    VtkPiece& piece = this->Piece;
    if (!piece.positions)
    {
      this->Scanner.fail("the file has no POINTS: it is truncated or damaged");
    }
    for (VtkCellList& list : piece.lists)
    {
      piece.cells += list.cells;
      if (this->IsGrid && (!list.types || list.types->values != list.cells))
      {
        this->Scanner.fail("the file has " + std::to_string(list.cells) + " CELLS, but " +
                           std::to_string(list.types ? list.types->values : 0) +
                           " CELL_TYPES: it is truncated or damaged");
      }
    }
    if (this->PointTuples >= 0 && this->PointTuples != piece.points)
    {
      this->Scanner.fail("POINT_DATA are for " + std::to_string(this->PointTuples) +
                         " points, but there are " + std::to_string(piece.points));
    }
    if (this->CellTuples >= 0 && this->CellTuples != piece.cells)
    {
      this->Scanner.fail("CELL_DATA are for " + std::to_string(this->CellTuples) +
                         " cells, but there are " + std::to_string(piece.cells));
    }
  }

  InputFile& File;
  LegacyVtkScanner Scanner;
  VtkPiece Piece;
  std::set<std::string> OtherArrays, RepeatedArrays, Fields; ///< see VtkLayout
  std::string GroupsText;
  VtkArrayNames PointNames, CellNames;
  bool IsGrid = false;
  bool OfPoints = false;
  std::vector<VtkArray>* Arrays = nullptr; ///< of the points or cells, for the current attributes
  std::int64_t Tuples = -1, PointTuples = -1, CellTuples = -1;
};

} // namespace

VtkLayout legacyVtkLayout(InputFile& file)
{
  return LegacyLayoutReader(file).read();
}

} // namespace smg
