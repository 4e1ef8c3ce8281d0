// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/TetGen/TetGenFormat.h"

#include "IO/Export/PlacedColumns.h"
#include "IO/Export/RestoredMesh.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextOutput.h"
#include "IO/Files/TextScanner.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace smg
{

namespace
{

/** The maximum number of attributes of a node or element; with more the file is damaged. */
constexpr std::int64_t MaxAttributes = 1024;

/** Reads the nodes and then the elements. */
class TetGenReader
{
public:
  explicit TetGenReader(RawMeshBuilder& builder)
    : Builder(builder)
  {
  }

  void readNodes(InputFile& file)
  {
    TextScanner scanner(file, '#', &this->Builder.workspace());
    scanner.locateErrors(
      [&]
      {
        const std::int64_t count = scanner.count("the number of nodes", 6);
        const std::int64_t dimension = scanner.integer("the dimension");
        if (dimension != 2 && dimension != 3)
        {
          scanner.fail("the dimension must be 2 or 3");
        }
        this->beginAttributes(scanner, ColumnOf::Vertices);
        const std::int64_t markers = numberInLine(scanner, "the number of boundary markers");
        if (markers != 0 && markers != 1)
        {
          scanner.fail("the number of boundary markers must be 0 or 1");
        }
        ImportColumn markerColumn;
        if (markers)
        {
          markerColumn =
            ImportColumn(this->Builder, ColumnOf::Vertices, { MarkerName, ScalarType::Int64, 1 });
        }
        for (std::int64_t i = 0; i < count; ++i)
        {
          this->readNode(scanner, i, static_cast<std::size_t>(dimension));
          this->Column.append(this->readAttributes(scanner));
          if (markers)
          {
            const std::int64_t marker = scanner.integer("the boundary marker of a node");
            markerColumn.append(std::as_bytes(std::span(&marker, 1)));
          }
        }
        checkEnd(scanner);
      });
  }

  void readElements(InputFile& file)
  {
    TextScanner scanner(file, '#', &this->Builder.workspace());
    scanner.locateErrors(
      [&]
      {
        const std::int64_t count = scanner.count("the number of elements", 8);
        const std::int64_t nodes = scanner.integer("the number of nodes of an element");
        if (nodes != 3 && nodes != 6 && nodes != 4 && nodes != 10)
        {
          scanner.fail("elements of " + std::to_string(nodes) +
                       " nodes are not read, only tetrahedra of 4 or 10 and triangles of 3 or 6");
        }
        this->beginAttributes(scanner, ColumnOf::Elements);
        this->Builder.numberVertices(this->First, this->Builder.vertices());
        for (std::int64_t i = 0; i < count; ++i)
        {
          this->readIndex(scanner, i, "an element");
          this->readElement(scanner, static_cast<std::size_t>(nodes));
          this->Column.append(this->readAttributes(scanner));
        }
        checkEnd(scanner);
      });
  }

private:
  /** A number at the end of a first line; 0 if missing. */
  static std::int64_t numberInLine(TextScanner& scanner, const char* what)
  {
    const std::string_view token = scanner.tokenInLine();
    return token.empty() ? 0 : scanner.toInteger(token, what);
  }

  static void checkEnd(TextScanner& scanner)
  {
    if (!scanner.atEnd())
    {
      scanner.fail(inQuotes(scanner.peek()) +
                   " stands after the last entry: the number in the first line is wrong");
    }
  }

  void beginAttributes(TextScanner& scanner, ColumnOf of)
  {
    const std::int64_t attributes = numberInLine(scanner, "the number of attributes");
    if (attributes < 0 || attributes > MaxAttributes)
    {
      scanner.fail("the number of attributes must be 0 to " + std::to_string(MaxAttributes) +
                   ", not " + std::to_string(attributes));
    }
    this->Attributes.resize(static_cast<std::size_t>(attributes));
    this->Column = attributes == 0
                     ? ImportColumn()
                     : ImportColumn(this->Builder, of,
                         { AttributeName, ScalarType::Float64, static_cast<int>(attributes) });
  }

  std::span<const std::byte> readAttributes(TextScanner& scanner)
  {
    for (double& attribute : this->Attributes)
    {
      attribute = scanner.number("an attribute");
    }
    return std::as_bytes(std::span<const double>(this->Attributes));
  }

  /** The number at the beginning of an entry; they count from that of the first node, 0 or 1. */
  void readIndex(TextScanner& scanner, std::int64_t place, const char* what)
  {
    const std::int64_t index = scanner.integer(what);
    if (index != this->First + place)
    {
      scanner.fail(std::string(what) + " has the number " + std::to_string(index) +
                   ", where number " + std::to_string(this->First + place) + " should be");
    }
  }

  void readNode(TextScanner& scanner, std::int64_t place, std::size_t dimension)
  {
    if (place == 0)
    {
      const std::string_view token = scanner.peek();
      this->First = token == "0" ? 0 : 1;
    }
    this->readIndex(scanner, place, "a node");
    std::array<double, 3> point{};
    for (double& coordinate : std::span(point).first(dimension))
    {
      coordinate = scanner.number("a coordinate of a node");
    }
    this->Builder.vertex(point[0], point[1], point[2]);
  }

  /** The nodes of an element, corners first. */
  void readElement(TextScanner& scanner, std::size_t nodes)
  {
    std::array<std::int64_t, 10> corners{};
    for (std::int64_t& corner : std::span(corners).first(nodes))
    {
      corner = scanner.integer("a node of an element");
    }
    const bool flat = nodes == 3 || nodes == 6;
    const std::int64_t before = this->Builder.cells();
    flat ? this->Builder.triangle(corners[0], corners[1], corners[2])
         : this->Builder.tetrahedron(corners[0], corners[1], corners[2], corners[3]);
    if (nodes > (flat ? 3U : 4U) && this->Builder.cells() > before)
    {
      this->Builder.noteHigherOrder();
    }
  }

  RawMeshBuilder& Builder;
  std::int64_t First = 1; ///< number of the first node and element
  ImportColumn Column;    ///< of the attributes
  std::vector<double> Attributes;
};

/** The name of the file, or its name before compression by gzip. */
std::filesystem::path plainName(const InputFile& file)
{
  std::filesystem::path name(file.name());
  return lowerSuffix(name) == ".gz" ? name.replace_extension() : name;
}

/** The other file of the two, possibly also compressed by gzip. */
std::filesystem::path otherFile(const InputFile& file, bool isElements)
{
  const std::filesystem::path plain =
    plainName(file).replace_extension(isElements ? ".node" : ".ele");
  const std::filesystem::path compressed = plain.string() + ".gz";
  for (const std::filesystem::path& other : { plain, compressed })
  {
    if (std::filesystem::exists(other))
    {
      return other;
    }
  }
  throw Error(file.name() + ": the file " + inQuotes(plain.string()) + ", which has the " +
              (isElements ? "nodes" : "elements") + ", must lie beside it.");
}

} // namespace

void importTetGen(InputFile& file, RawMeshBuilder& builder)
{
  const bool isElements = lowerSuffix(plainName(file)) == ".ele";
  const std::filesystem::path otherPath = otherFile(file, isElements);
  std::optional<InflatedFile> inflated;
  {
    InputFile start(otherPath);
    if (isGzip(start.at(0, 2)))
    {
      inflated.emplace(start, builder.workspace(), "inflated-other");
    }
  }
  InputFile other(inflated ? inflated->path() : otherPath, {}, otherPath.string());
  TetGenReader reader(builder);
  reader.readNodes(isElements ? other : file);
  reader.readElements(isElements ? file : other);
}

namespace
{

constexpr FileSuffix TetGenSuffixes[] = { { ".node", true, true, true },
  { ".ele", true, true, true } };

} // namespace

const Format TetGenFormat{
  .name = "TetGen",
  .suffixes = TetGenSuffixes,
  .attributes = "attributes and markers of vertices, attributes of cells",
  .parse = parseWith<importTetGen>,
  .share = { 200, 4 },
  .bytes = bytesOfTetGen,
  .restore = writeRestoredTetGen,
};

namespace
{

constexpr int AnyNumber = std::numeric_limits<int>::max();

int components(const std::vector<ColumnSpec>& specs, std::ptrdiff_t column)
{
  return column < 0 ? 0 : specs[static_cast<std::size_t>(column)].components;
}

void writeNodes(TextOutput& out, RestoredMesh& mesh, PlacedColumns& columns)
{
  const RestoredInfo& info = mesh.info();
  const std::ptrdiff_t attributes = columns.ofVertices(AttributeName, 1, AnyNumber);
  const std::ptrdiff_t markers = columns.integerOfVertices({ MarkerName, ReferenceName });
  out << info.vertices << " 3 " << components(info.vertexColumns, attributes) << ' '
      << components(info.vertexColumns, markers) << '\n';
  for (RestoredVertices vertices; mesh.next(vertices);)
  {
    const std::span<const double> positions = vertices.positions;
    for (std::size_t i = 0; i < static_cast<std::size_t>(vertices.count()); ++i)
    {
      out << vertices.first + static_cast<std::int64_t>(i) + 1 << ' ';
      out.position(positions.subspan(3 * i, 3), info.doublePositions);
      out.tuple(vertices.columns, attributes, i);
      out.tuple(vertices.columns, markers, i);
      out << '\n';
    }
  }
}

/** Tetrahedra, or polygons as triangles. */
void writeElements(TextOutput& out, RestoredMesh& mesh, PlacedColumns& columns)
{
  const RestoredInfo& info = mesh.info();
  std::ptrdiff_t attributes = columns.ofElements(AttributeName, 1, AnyNumber);
  if (attributes < 0)
  {
    attributes = columns.integerOfElements({ ReferenceName, PhysicalTagName });
  }
  out << info.cells << ' ' << cornersOf(info.cellType) << ' '
      << components(info.elementColumns, attributes) << '\n';
  std::int64_t number = 0;
  for (RestoredElements elements; mesh.next(elements);)
  {
    const auto write = [&](std::size_t element, std::span<const std::int64_t> corners)
    {
      out << ++number;
      for (const std::int64_t corner : corners)
      {
        out << ' ' << corner + 1;
      }
      out.tuple(elements.columns, attributes, element);
      out << '\n';
    };
    elements.forEach(
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        info.cellType == CellType::Triangle
          ? forEachFanTriangle(corners, [&](const auto& triangle) { write(element, triangle); })
          : write(element, corners);
      });
  }
}

} // namespace

WriteNotes writeRestoredTetGen(RestoredMesh& mesh, const std::filesystem::path& path)
{
  PlacedColumns columns(mesh.info());
  const bool namesNodes = lowerSuffix(path) == ".node";
  const auto beside = [&path](const char* suffix)
  { return std::filesystem::path(path).replace_extension(suffix); };
  TextOutput nodes(namesNodes ? path : beside(".node"));
  TextOutput elements(namesNodes ? beside(".ele") : path);
  writeNodes(nodes, mesh, columns);
  writeElements(elements, mesh, columns);
  // Neither is renamed before both are on the disk.
  nodes.write();
  elements.write();
  nodes.finish();
  elements.finish();
  WriteNotes notes = columns.leftOut(".node and .ele");
  if (mesh.info().cellType == CellType::Triangle && mesh.info().maxCorners > 3)
  {
    notes.emplace_back("Polygons are written as triangles.");
  }
  return notes;
}

std::int64_t bytesOfTetGen(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const double attributes =
    tupleCharacters(mesh.vertexColumns, columns.ofVertices(AttributeName, 1, AnyNumber)) +
    tupleCharacters(mesh.vertexColumns, columns.integerOfVertices({ MarkerName, ReferenceName }));
  std::ptrdiff_t ofCells = columns.ofElements(AttributeName, 1, AnyNumber);
  ofCells = ofCells < 0 ? columns.integerOfElements({ ReferenceName, PhysicalTagName }) : ofCells;
  return textBytes(mesh.vertices, numberCharacters(mesh.vertices) +
                                    positionCharacters(mesh.doublePositions) + attributes) +
         textBytes(mesh.cells, numberCharacters(mesh.cells) +
                                 cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells));
}

} // namespace smg
