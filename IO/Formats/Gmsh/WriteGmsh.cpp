// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Gmsh/WriteGmsh.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/TextOutput.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace smg
{
namespace
{

/** Version 2.2, text: triangles, quadrilaterals or tetrahedra, with the tags of cells, and a
 * further element for each group of a facet or vertex. */
class GmshWriter : public MeshFileWriter
{
public:
  GmshWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Out(path)
    , Info(info)
    , Columns(info)
    , Group(this->Columns.integerOfElements({ PhysicalTagName, ReferenceName }))
    , Entity(this->Columns.integerOfElements({ GeometricalTagName }))
    , Sets(this->Columns.integerOfElements({ CellGroupsName }))
    , Dimension(cornersOf(info.cellType) - 1)
  {
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
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    this->beginElements();
    chunk.forEachUpTo(4,
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        const int type = this->Info.cellType == CellType::Tetrahedron ? Tetrahedron
                         : corners.size() == 4                        ? Quadrilateral
                                                                      : Triangle;
        // Two tags, which Gmsh requires.
        this->Out << ++this->Elements << ' ' << type << " 2";
        if (this->Info.groups && this->Sets >= 0)
        {
          this->Out << ' ' << this->groupOf(chunk.columns[std::size_t(this->Sets)], element);
        }
        else
        {
          this->Out.tuple(chunk.columns, this->Group, element, " 0");
        }
        this->Out.tuple(chunk.columns, this->Entity, element, " 1");
        this->Out.corners(corners, 1);
        this->Out << '\n';
      });
  }

  WriteNotes finish() override
  {
    this->beginElements();
    this->writeGroups();
    this->Out << "$EndElements\n";
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".msh");
    if (this->InSeveral > 0)
    {
      notes.push_back(counted(this->InSeveral, "cell is", "cells are") +
                      " in several groups, of which the file has the first one.");
    }
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

  /** Begins the section of the elements, unless there are some already. */
  void beginElements()
  {
    if (!this->HasBegun)
    {
      this->HasBegun = true;
      std::int64_t more = 0;
      if (this->Info.groups)
      {
        more = this->Info.groups->memberships(GroupOf::Facets) +
               this->Info.groups->memberships(GroupOf::Vertices);
      }
      // All cells of the stream, except for one of the two triangles of each quadrilateral.
      this->Out << "$EndNodes\n$Elements\n"
                << this->Info.cells - this->Info.quadrilaterals + more << '\n';
    }
  }

  /** The number of the group of a cell; 0: none. */
  std::int64_t groupOf(const Column& sets, std::size_t element)
  {
    const auto groups = this->Info.groups->groupsOf(sets.as<GroupSet>()[element], GroupOf::Cells);
    this->InSeveral += groups.size() > 1 ? 1 : 0;
    return groups.empty() ? 0 : this->Info.groups->numberOf(groups.front());
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
        [&](std::span<const std::int64_t> corners, GroupSet set)
        {
          for (const std::uint32_t group : this->Info.groups->groupsOf(set, kind))
          {
            this->Out << ++this->Elements << ' ' << type << " 2 "
                      << this->Info.groups->numberOf(group) << " 1";
            this->Out.corners(corners, 1);
            this->Out << '\n';
          }
        });
    }
  }

  TextOutput Out;
  const MeshFileInfo Info;
  PlacedColumns Columns;
  std::ptrdiff_t Group, Entity, Sets; ///< columns
  int Dimension;                      ///< of the cells
  std::int64_t Elements = 0;
  std::int64_t InSeveral = 0; ///< cells in several groups
  bool HasBegun = false;      ///< whether the section of the elements has
};

} // namespace

std::unique_ptr<MeshFileWriter> makeGmshWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return makeWriter<GmshWriter>(path, info, workspace);
}

} // namespace smg
