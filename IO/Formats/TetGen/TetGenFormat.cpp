// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Files/FileNames.h"
#include "IO/Files/Inflate.h"
#include "IO/Files/InputFile.h"
#include "IO/Files/TextScanner.h"
#include "IO/Formats/Foreign/ForeignFile.h"
#include "IO/Formats/TetGen/WriteTetGen.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/LabelGroups.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "IO/Mesh/Format.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
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
        LabelGroups labels;
        if (markers)
        {
          markerColumn =
            ImportColumn(this->Builder, ColumnOf::Vertices, { MarkerName, ScalarType::Int64, 1 });
        }
        // The first one has the number from which all count.
        const bool looks = this->Builder.looks();
        const std::int64_t read = looks ? std::min<std::int64_t>(count, 1) : count;
        for (std::int64_t i = 0; i < read; ++i)
        {
          this->readNode(scanner, i, static_cast<std::size_t>(dimension));
          this->Column.append(this->readAttributes(scanner));
          if (markers)
          {
            const std::int64_t marker = scanner.integer("the boundary marker of a node");
            markerColumn.append(std::as_bytes(std::span(&marker, 1)));
            labels.add(marker);
          }
        }
        if (!looks)
        {
          checkEnd(scanner);
        }
        markerColumn.close();
        this->Builder.numberVertices(this->First, this->Builder.vertices());
        labels.groupVertices(this->Builder, markerColumn, this->First);
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
        this->Nodes = static_cast<std::size_t>(nodes);
        LabelGroups regions;
        for (std::int64_t i = 0; i < count; ++i)
        {
          this->readIndex(scanner, i, "an element");
          this->readElement(scanner);
          this->Column.append(this->readAttributes(scanner));
          if (!this->Attributes.empty())
          {
            regions.add(this->Attributes.back());
          }
        }
        checkEnd(scanner);
        this->Column.close();
        const int dimension = this->cornersOfElement() - 1;
        regions.forEach<double>(this->Column, this->Attributes.size(),
          [&](std::int64_t element, std::int64_t region)
          {
            this->Builder.alsoIn(
              element, dimension, {}, this->Builder.groups().numbered(dimension, region));
          });
      });
  }

  /** The faces or edges beside the elements, with their markers. */
  void readSides(InputFile& file, int dimension)
  {
    TextScanner scanner(file, '#', &this->Builder.workspace());
    scanner.locateErrors(
      [&]
      {
        const std::int64_t count = scanner.count("the number of faces or edges", 6);
        const bool hasMarkers = numberInLine(scanner, "the number of boundary markers") != 0;
        const auto corners = static_cast<std::size_t>(dimension) + 1;
        const bool isQuadratic = this->Nodes == 6 || this->Nodes == 10;
        // Of a face of second order three more nodes, of an edge one.
        const std::size_t others = isQuadratic ? (dimension == 2 ? 3 : 1) : 0;
        for (std::int64_t i = 0; i < count && hasMarkers; ++i)
        {
          this->readIndex(scanner, i, "a face or edge");
          std::array<std::int64_t, 6> nodes{};
          for (std::int64_t& node : std::span(nodes).first(corners + others))
          {
            node = scanner.integer("a node of a face or edge");
          }
          const std::int64_t marker = scanner.integer("the boundary marker of a face or edge");
          if (marker != 0)
          {
            this->Builder.grouped(dimension, std::span(nodes).first(corners),
              this->Builder.groups().numbered(dimension, marker));
          }
          scanner.skipLine(); // neighbours may follow
        }
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
      attribute = scanner.toNumber(scanner.token(), "an attribute", false);
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
  void readElement(TextScanner& scanner)
  {
    std::array<std::int64_t, 10> corners{};
    for (std::int64_t& corner : std::span(corners).first(this->Nodes))
    {
      corner = scanner.integer("a node of an element");
    }
    const int count = this->cornersOfElement();
    this->Builder.element(count - 1, std::span(corners).first(static_cast<std::size_t>(count)),
      this->Nodes > static_cast<std::size_t>(count));
  }

  int cornersOfElement() const { return this->Nodes % 3 == 0 ? 3 : 4; }

  RawMeshBuilder& Builder;
  std::int64_t First = 1; ///< number of the first node and element
  std::size_t Nodes = 0;  ///< of an element
  ImportColumn Column;    ///< of the attributes
  std::vector<double> Attributes;
};

/** The other file of the two, possibly also compressed; empty: there is none. */
std::filesystem::path otherFile(const std::filesystem::path& name)
{
  return plainOrCompressed(
    plainTetGenName(name).replace_extension(isOfTetGenElements(name) ? ".node" : ".ele"));
}

std::filesystem::path sideFile(const std::filesystem::path& name, const char* suffix)
{
  return plainOrCompressed(plainTetGenName(name).replace_extension(suffix));
}

std::vector<std::filesystem::path> furtherTetGenInputs(const std::filesystem::path& path)
{
  std::vector<std::filesystem::path> others{ otherFile(path), sideFile(path, TetGenFaces),
    sideFile(path, TetGenEdges) };
  std::erase_if(others, [](const std::filesystem::path& other) { return other.empty(); });
  return others;
}

/** Calls `read` with a file beside the one that is read, which may be compressed. */
template <class Read>
void withFurtherFile(const std::filesystem::path& path, Workspace& space, Read&& read)
{
  std::optional<InflatedFile> inflated;
  {
    InputFile start(path);
    if (isCompressed(start))
    {
      inflated.emplace(start, space, "inflated-other");
    }
  }
  InputFile input(inflated ? inflated->path() : path, {}, path.string());
  read(input);
}

void importTetGen(InputFile& file, RawMeshBuilder& builder)
{
  const bool isElements = isOfTetGenElements(file.name());
  const std::filesystem::path otherPath = otherFile(file.name());
  if (otherPath.empty())
  {
    const std::filesystem::path absent =
      plainTetGenName(file.name()).replace_extension(isElements ? ".node" : ".ele");
    throw Error(file.name() + ": the file " + inQuotes(absent.string()) + ", which has the " +
                (isElements ? "nodes" : "elements") + ", must lie beside it.");
  }
  TetGenReader reader(builder);
  withFurtherFile(otherPath, builder.workspace(),
    [&](InputFile& other)
    {
      // Its beginning says nothing of a mesh.
      refuseForeign(other.name(), other.at(0, FormatBytes).substr(0, FormatBytes), &TetGenFormat);
      reader.readNodes(isElements ? other : file);
      reader.readElements(isElements ? file : other);
    });
  for (const auto& [suffix, dimension] : { std::pair(TetGenFaces, 2), std::pair(TetGenEdges, 1) })
  {
    const std::filesystem::path sides = sideFile(file.name(), suffix);
    if (!sides.empty() && !builder.looks())
    {
      withFurtherFile(
        sides, builder.workspace(), [&](InputFile& input) { reader.readSides(input, dimension); });
    }
  }
}

constexpr FileSuffix TetGenSuffixes[] = { { ".node", true, true, FileForm::Text },
  { ".ele", true, true, FileForm::Text } };

} // namespace

const Format TetGenFormat{
  .name = "TetGen",
  .suffixes = TetGenSuffixes,
  .description = "two files in a folder, either of which may be named; the `.face` "
                 "and `.edge` beside them, if any, have groups",
  .cells = "triangles, tetrahedra",
  .groups = GroupForm::Elements,
  .parse = parseWith<importTetGen>,
  .typicalBytes = { 200, 4 },
  .bytes = bytesOfTetGen,
  .writer = makeTetGenWriter,
  .maxCorners = 3,
  .furtherInputs = furtherTetGenInputs,
  .furtherOutputs = furtherTetGenOutputs,
};

} // namespace smg
