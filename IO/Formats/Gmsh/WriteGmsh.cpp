// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/WriteGmsh.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/KeptColumns.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/TextOutput.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// Version 2.2, text: triangles, quadrilaterals or tetrahedra with the tags of cells, and an element
// for each group of a facet or vertex, then the other columns as data. A cell in several groups is
// there once for each, one after the other, as Gmsh writes it. Gmsh reads physical groups as those
// of entities: what is in the same groups is an entity.

namespace smg
{
namespace
{

/** Data have 1, 3 or 9 components. */
constexpr int MostComponents = 9;
int gmshComponents(int components)
{
  return components == 1 ? 1 : components <= 3 ? 3 : MostComponents;
}

class GmshWriter : public MeshFileWriter
{
public:
  GmshWriter(const std::filesystem::path& path, const MeshFileInfo& info, Workspace& workspace)
    : Out(path)
    , Info(info)
    , Columns(info)
    , Group(this->Columns.integerOfElements({ PhysicalTagName, ReferenceName, "gmsh:physical" }))
    , Entity(this->Columns.integerOfElements({ GeometricalTagName, "gmsh:geometrical" }))
    , Sets(this->Columns.integerOfElements({ CellGroupsName }))
    , Dimension(cornersOf(info.cellType) - 1)
    // All cells of the stream, except for one of the two triangles of each quadrilateral.
    , Cells(info.cells - info.quadrilaterals)
  {
    this->Columns.integerOfVertices({ VertexGroupsName });
    this->OfNodes.emplace(
      workspace, info.vertexColumns, this->Columns.othersOfVertices(MostComponents));
    this->OfElements.emplace(
      workspace, info.elementColumns, this->Columns.othersOfElements(MostComponents));
    this->Sets = info.groups ? this->Sets : -1;
    const bool areInSeveral = info.groups && info.groups->memberships(GroupOf::Cells) >
                                               info.groups->grouped(GroupOf::Cells);
    this->Counts = areInSeveral;
    this->Out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    this->writeNames();
    this->Out << "$Nodes\n" << info.vertices << '\n';
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out << chunk.first + static_cast<std::int64_t>(vertex) + 1 << ' ';
        this->Out.position(position, this->Info.doublePositions);
        this->Out << '\n';
        this->OfNodes->append(chunk.columns, vertex);
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    if (!this->Counts)
    {
      this->beginElements();
    }
    chunk.forEachUpTo(4,
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        std::vector<std::uint32_t> groups;
        GroupSet set = 0;
        if (this->Sets >= 0)
        {
          set = chunk.columns[static_cast<std::size_t>(this->Sets)].as<GroupSet>()[element];
          groups = this->Info.groups->groupsOf(set, GroupOf::Cells);
        }
        if (this->Counts)
        {
          this->Further += std::max<std::int64_t>(std::ssize(groups) - 1, 0);
          return;
        }
        for (std::size_t k = 0; k < std::max<std::size_t>(groups.size(), 1); ++k)
        {
          this->writeCell(chunk, element, corners, k, set, groups);
          this->OfElements->append(chunk.columns, element);
        }
      });
  }

  bool needsElementsAgain() override { return std::exchange(this->Counts, false); }

  WriteNotes finish() override
  {
    this->beginElements();
    this->writeGroups();
    this->Out << "$EndElements\n";
    WriteNotes notes = this->Columns.leftOut(".msh");
    this->writeData("$NodeData", "$EndNodeData", this->Info.vertices, *this->OfNodes, notes);
    this->writeData("$ElementData", "$EndElementData", this->Elements, *this->OfElements, notes);
    this->Out.finish();
    return notes;
  }

private:
  enum Type
  {
    Line = 1,
    Triangle,
    Quadrilateral,
    Tetrahedron,
    Point = 15
  };

  int dimensionOf(GroupOf kind) const
  {
    return kind == GroupOf::Cells    ? this->Dimension
           : kind == GroupOf::Facets ? this->Dimension - 1
                                     : 0;
  }

  void writeNames()
  {
    if (!this->Info.groups)
    {
      return;
    }
    const std::vector<smg::Group>& groups = this->Info.groups->groups().groups;
    const auto named =
      std::ranges::count_if(groups, [](const smg::Group& group) { return !group.name.empty(); });
    if (named == 0)
    {
      return;
    }
    this->Out << "$PhysicalNames\n" << named << '\n';
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      if (!groups[g].name.empty())
      {
        this->Out << this->dimensionOf(groups[g].of) << ' '
                  << this->Info.groups->numberOf(static_cast<std::uint32_t>(g)) << " \""
                  << groups[g].name << "\"\n";
      }
    }
    this->Out << "$EndPhysicalNames\n";
  }

  /** Begins the section of the elements, unless it has begun. */
  void beginElements()
  {
    if (!this->HasBegun)
    {
      this->HasBegun = true;
      std::int64_t more = this->Further;
      if (this->Info.groups)
      {
        more += this->Info.groups->memberships(GroupOf::Facets) +
                this->Info.groups->memberships(GroupOf::Vertices);
      }
      this->Out << "$EndNodes\n$Elements\n" << this->Cells + more << '\n';
    }
  }

  /** The entity of what is in these groups. */
  std::int64_t entityOf(GroupSet set) const
  {
    return set > 0 ? set : std::ssize(this->Info.groups->groups().sets);
  }

  /** A cell as a member of its `k`-th group. */
  void writeCell(const ElementChunk& chunk, std::size_t element,
    std::span<const std::int64_t> corners, std::size_t k, GroupSet set,
    std::span<const std::uint32_t> groups)
  {
    const int type = this->Info.cellType == CellType::Tetrahedron ? Tetrahedron
                     : corners.size() == 4                        ? Quadrilateral
                                                                  : Triangle;
    // Two tags, which Gmsh requires.
    this->Out << ++this->Elements << ' ' << type << " 2";
    if (this->Sets >= 0)
    {
      this->Out << ' ' << (groups.empty() ? 0 : this->Info.groups->numberOf(groups[k]));
    }
    else
    {
      this->Out.tuple(chunk.columns, this->Group, element, " 0");
    }
    if (this->Entity < 0 && this->Sets >= 0)
    {
      this->Out << ' ' << this->entityOf(set);
    }
    else
    {
      this->Out.tuple(chunk.columns, this->Entity, element, " 1");
    }
    this->Out.corners(corners, 1);
    this->Out << '\n';
  }

  void writeGroups()
  {
    for (const GroupOf kind : { GroupOf::Facets, GroupOf::Vertices })
    {
      if (!this->Info.groups)
      {
        return;
      }
      const int type = kind == GroupOf::Vertices ? Point : this->Dimension == 3 ? Triangle : Line;
      this->Info.groups->forEach(kind,
        [&](std::span<const std::int64_t> corners, GroupSet set, std::int64_t)
        {
          for (const std::uint32_t group : this->Info.groups->groupsOf(set, kind))
          {
            this->Out << ++this->Elements << ' ' << type << " 2 "
                      << this->Info.groups->numberOf(group) << ' ' << this->entityOf(set);
            this->Out.corners(corners, 1);
            this->Out << '\n';
          }
        });
    }
  }

  /** Columns as data of all nodes or elements, in their order, as other programs expect them: NaN
   * of elements that are no cells. */
  void writeData(std::string_view begin, std::string_view end, std::int64_t count,
    KeptColumns& columns, WriteNotes& notes)
  {
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const ColumnSpec& spec = columns.spec(c);
      const int components = gmshComponents(spec.components);
      std::string name = spec.name;
      std::ranges::replace(name, '"', '\'');
      this->Out << begin << "\n1\n\"" << name << "\"\n1\n0\n3\n0\n"
                << components << '\n'
                << count << '\n';
      std::int64_t number = 0;
      columns.forEach(c,
        [&](const std::vector<Column>& some)
        {
          for (std::size_t tuple = 0; tuple < some[0].bytes.size() / spec.tupleBytes(); ++tuple)
          {
            this->Out << ++number;
            this->Out.tuple(some, 0, tuple);
            for (int k = spec.components; k < components; ++k)
            {
              this->Out << " 0";
            }
            this->Out << '\n';
          }
        });
      while (number < count)
      {
        this->Out << ++number;
        for (int k = 0; k < components; ++k)
        {
          this->Out << " nan";
        }
        this->Out << '\n';
      }
      this->Out << end << '\n';
      if (components != spec.components)
      {
        notes.push_back("The column " + inQuotes(spec.name) + " has " + std::to_string(components) +
                        " components in the file, since data have 1, "
                        "3 or 9: the further ones are 0.");
      }
    }
  }

  TextOutput Out;
  const MeshFileInfo Info;
  PlacedColumns Columns;
  std::ptrdiff_t Group, Entity, Sets; ///< columns
  int Dimension;                      ///< of the cells
  std::int64_t Cells;                 ///< triangles, quadrilaterals or tetrahedra
  std::optional<KeptColumns> OfNodes, OfElements;
  std::int64_t Elements = 0; ///< so far
  std::int64_t Further = 0;  ///< memberships of cells after their first one
  bool Counts = false;       ///< whether these are being counted
  bool HasBegun = false;     ///< whether the section of the elements has
};

} // namespace

std::unique_ptr<MeshFileWriter> makeGmshWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return std::make_unique<GmshWriter>(path, info, *workspace);
}

namespace
{

/** The columns that are written as data. */
std::vector<ColumnSpec> gmshData(const StreamInfo& mesh, bool ofVertices)
{
  PlacedColumns columns(mesh);
  columns.integerOfElements({ PhysicalTagName, ReferenceName, "gmsh:physical" });
  columns.integerOfElements({ GeometricalTagName, "gmsh:geometrical" });
  columns.integerOfElements({ CellGroupsName });
  columns.integerOfVertices({ VertexGroupsName });
  std::vector<ColumnSpec> data;
  for (const std::size_t place : ofVertices ? columns.othersOfVertices(MostComponents)
                                            : columns.othersOfElements(MostComponents))
  {
    data.push_back((ofVertices ? mesh.vertexColumns : mesh.cellColumns)[place]);
  }
  return data;
}

} // namespace

std::int64_t bytesOfGmsh(const MeshToWrite& written)
{
  constexpr double TypeAndTags = 8; // as "4 2 0 1 "
  const StreamInfo& mesh = written.mesh;
  const auto dataBytes = [&](bool ofVertices, std::int64_t rows)
  {
    const std::vector<ColumnSpec> data = gmshData(mesh, ofVertices);
    std::int64_t bytes = 0;
    for (std::size_t c = 0; c < data.size(); ++c)
    {
      bytes += textBytes(
        rows, numberCharacters(rows) + tupleCharacters(data, static_cast<std::ptrdiff_t>(c)));
    }
    return bytes;
  };
  return textBytes(mesh.vertices,
           numberCharacters(mesh.vertices) + positionCharacters(mesh.doublePositions)) +
         textBytes(mesh.cells, numberCharacters(mesh.cells) + TypeAndTags +
                                 cornersOf(mesh.cellType) * numberCharacters(mesh.vertices)) +
         dataBytes(true, mesh.vertices) + dataBytes(false, mesh.cells);
}

std::int64_t scratchOfGmsh(const StreamInfo& mesh, std::int64_t, bool)
{
  return mesh.vertices * rowBytes(gmshData(mesh, true)) +
         mesh.cells * rowBytes(gmshData(mesh, false));
}

} // namespace smg
