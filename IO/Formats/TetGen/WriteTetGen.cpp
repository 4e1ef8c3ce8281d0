// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/TetGen/WriteTetGen.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/WrittenLabels.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/UsedFiles.h"
#include "IO/Mesh/Columns.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>

// Vertices with attributes and markers, tetrahedra or triangles with attributes, and the faces or
// edges in groups with their markers. Markers are those of columns, else the numbers of groups.

namespace smg
{
namespace
{

constexpr int AnyNumber = std::numeric_limits<int>::max();

int components(const std::vector<ColumnSpec>& specs, std::ptrdiff_t column)
{
  return column < 0 ? 0 : specs[static_cast<std::size_t>(column)].components;
}

/** A file of a mesh that is written: of the one that is named, or with another suffix. */
std::filesystem::path fileOf(const std::filesystem::path& path, const char* suffix)
{
  return std::filesystem::path(path).replace_extension(
    lowerSuffix(path) == suffix ? path.extension() : suffix);
}

const char* sideSuffix(CellType cells)
{
  return cells == CellType::Tetrahedron ? TetGenFaces : TetGenEdges;
}

class TetGenWriter : public MeshFileWriter
{
public:
  TetGenWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Path(path)
    , Info(info)
    , Nodes(fileOf(path, ".node"))
    , Elements(fileOf(path, ".ele"))
    , CornersOfCell(cornersOf(info.cellType))
    , Columns(info)
    , Attributes(this->Columns.ofVertices(AttributeName, 1, AnyNumber))
    , Markers(this->Columns, info, GroupOf::Vertices, { MarkerName, ReferenceName })
    , CellAttributes(this->Columns.ofElements(AttributeName, 1, AnyNumber))
    , Regions(this->Columns, info, GroupOf::Cells,
        this->CellAttributes < 0
          ? std::initializer_list<std::string_view>{ ReferenceName, PhysicalTagName }
          : std::initializer_list<std::string_view>{})
  {
    const bool hasRegions = this->CellAttributes < 0 && this->Regions.exist();
    this->Nodes << info.vertices << " 3 " << components(info.vertexColumns, this->Attributes) << ' '
                << (this->Markers.exist() ? 1 : 0) << '\n';
    this->Elements << info.cells << ' ' << this->CornersOfCell << ' '
                   << (hasRegions ? 1 : components(info.elementColumns, this->CellAttributes))
                   << '\n';
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Nodes << chunk.first + static_cast<std::int64_t>(vertex) + 1 << ' ';
        this->Nodes.position(position, this->Info.doublePositions);
        this->Nodes.tuple(chunk.columns, this->Attributes, vertex);
        this->Markers.write(this->Nodes, chunk.columns, vertex);
        this->Nodes << '\n';
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    chunk.forEachUpTo(static_cast<std::size_t>(this->CornersOfCell),
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        this->Elements << ++this->Count;
        this->Elements.corners(corners, 1);
        this->CellAttributes < 0
          ? this->Regions.write(this->Elements, chunk.columns, element)
          : this->Elements.tuple(chunk.columns, this->CellAttributes, element);
        this->Elements << '\n';
      });
  }

  WriteNotes finish() override
  {
    WriteNotes notes;
    this->writeSides(notes);
    // None is renamed before all are on the disk.
    this->Nodes.write();
    this->Elements.write();
    this->Nodes.finish();
    this->Elements.finish();
    if (this->Sides)
    {
      this->Sides->finish();
    }
    const WriteNotes leftOut = this->Columns.leftOut(".node and .ele");
    notes.insert(notes.end(), leftOut.begin(), leftOut.end());
    const auto none = [](const Group&) { return false; };
    this->CellAttributes < 0
      ? noteLabels(this->Info, { &this->Markers, &this->Regions }, none, notes)
      : noteLabels(this->Info, { &this->Markers }, none, notes);
    return notes;
  }

private:
  /** A facet is written once for each of its groups. */
  void writeSides(WriteNotes& notes)
  {
    const std::int64_t count =
      this->Info.groups ? this->Info.groups->memberships(GroupOf::Facets) : 0;
    for (const char* const suffix : { TetGenFaces, TetGenEdges })
    {
      const std::filesystem::path other = fileOf(this->Path, suffix);
      std::error_code error;
      const bool isWritten = count > 0 && suffix == sideSuffix(this->Info.cellType);
      if (!isWritten && std::filesystem::exists(other, error))
      {
        notes.push_back("The file " + inQuotes(other.string()) +
                        " is of another mesh, but is read with this one: remove it.");
      }
    }
    if (count == 0)
    {
      return;
    }
    TextOutput& out = this->Sides.emplace(fileOf(this->Path, sideSuffix(this->Info.cellType)));
    out << count << " 1\n";
    std::int64_t number = 0;
    this->Info.groups->forEach(GroupOf::Facets,
      [&](std::span<const std::int64_t> corners, GroupSet set, std::int64_t)
      {
        for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Facets))
        {
          out << ++number;
          out.corners(corners, 1);
          out << ' ' << this->Info.groups->numberOf(group) << '\n';
        }
      });
    out.write();
  }

  std::filesystem::path Path;
  const MeshFileInfo Info;
  TextOutput Nodes, Elements;
  std::optional<TextOutput> Sides; ///< if there are any
  int CornersOfCell;
  PlacedColumns Columns;
  std::ptrdiff_t Attributes;
  WrittenLabels Markers;
  std::ptrdiff_t CellAttributes;
  WrittenLabels Regions;
  std::int64_t Count = 0; ///< of cells
};

} // namespace

/** The name of a file before compression. */
std::filesystem::path plainTetGenName(std::filesystem::path name)
{
  return isCompressedSuffix(lowerSuffix(name)) ? name.replace_extension() : name;
}

bool isOfTetGenElements(const std::filesystem::path& name)
{
  return lowerSuffix(plainTetGenName(name)) == ".ele";
}

std::vector<std::filesystem::path> furtherTetGenOutputs(const std::filesystem::path& path)
{
  return { fileOf(path, isOfTetGenElements(path) ? ".node" : ".ele"), fileOf(path, TetGenFaces),
    fileOf(path, TetGenEdges) };
}

std::unique_ptr<MeshFileWriter> makeTetGenWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return makeWriter<TetGenWriter>(path, info, workspace);
}

std::int64_t bytesOfTetGen(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const double attributes =
    tupleCharacters(mesh.vertexColumns, columns.ofVertices(AttributeName, 1, AnyNumber)) +
    tupleCharacters(mesh.vertexColumns, columns.integerOfVertices({ MarkerName, ReferenceName }));
  const std::ptrdiff_t all = columns.ofElements(AttributeName, 1, AnyNumber);
  const std::ptrdiff_t ofCells =
    all < 0 ? columns.integerOfElements({ ReferenceName, PhysicalTagName }) : all;
  return textBytes(mesh.vertices, numberCharacters(mesh.vertices) +
                                    positionCharacters(mesh.doublePositions) + attributes) +
         textBytes(mesh.cells, numberCharacters(mesh.cells) +
                                 cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells));
}

} // namespace smg
