// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Medit/WriteMedit.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Export/WrittenLabels.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Medit/MeditSections.h"
#include "IO/Mesh/Columns.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

// Tetrahedra, or triangles and then quadrilaterals, then the facets in groups, once for each group.
// A reference is that of a column or, if there is none, the number of the first group. Lists of
// vertices and facets, as RequiredVertices, are the groups of their names.

namespace smg
{
namespace
{

class MeditWriter : public MeshFileWriter
{
public:
  MeditWriter(const std::filesystem::path& path, const MeshFileInfo& info)
    : Out(path)
    , Info(info)
    , Columns(info)
    , OfVertices(this->Columns, info, GroupOf::Vertices, { ReferenceName, MarkerName })
    , OfCells(this->Columns, info, GroupOf::Cells, { ReferenceName, PhysicalTagName })
    // All triangles of the stream, except for the two of each quadrilateral.
    , Triangles(info.cellType == CellType::Triangle ? info.cells - 2 * info.quadrilaterals : 0)
    , WritesQuadrilaterals(this->Triangles == 0)
  {
    this->OfVertices.leaveTo([this](const Group& group) { return this->listOf(group) != nullptr; });
    this->Out << "MeshVersionFormatted " << (info.doublePositions ? 2 : 1)
              << "\nDimension 3\nVertices\n"
              << info.vertices << '\n';
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out.position(position, this->Info.doublePositions);
        this->OfVertices.write(this->Out, chunk.columns, vertex, " 0");
        this->Out << '\n';
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    if (chunk.first == 0)
    {
      this->beginSection();
    }
    const bool isSurface = this->Info.cellType == CellType::Triangle;
    chunk.forEachUpTo(4,
      [&](std::span<const std::int64_t> corners, std::size_t element)
      {
        if (isSurface && (corners.size() == 4) != this->WritesQuadrilaterals)
        {
          return;
        }
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
          this->Out << (k > 0 ? " " : "") << corners[k] + 1;
        }
        this->OfCells.write(this->Out, chunk.columns, element, " 0");
        this->Out << '\n';
      });
  }

  /** For the section of the quadrilaterals, which comes after the triangles. */
  bool needsElementsAgain() override
  {
    const bool again = !this->WritesQuadrilaterals && this->Info.quadrilaterals > 0;
    this->WritesQuadrilaterals = true;
    return again;
  }

  WriteNotes finish() override
  {
    if (this->Info.groups)
    {
      this->writeFacets();
      this->writeLists();
    }
    this->Out << "End\n";
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".mesh");
    noteLabels(
      this->Info, { &this->OfVertices, &this->OfCells },
      [this](const Group& group) { return this->listOf(group) != nullptr; }, notes);
    if (this->Info.quadrilaterals > 0 && this->Info.quadrilaterals < this->Info.elements)
    {
      notes.push_back("The quadrilaterals come after the triangles, as the format has it.");
    }
    return notes;
  }

private:
  std::string_view facetSection() const
  {
    return this->Info.cellType == CellType::Tetrahedron ? "Triangles" : "Edges";
  }

  /** The section that lists the members of a group; null: they have references. */
  const MeditList* listOf(const Group& group) const
  {
    const std::string_view items = group.of == GroupOf::Vertices ? ""
                                   : group.of == GroupOf::Facets ? this->facetSection()
                                                                 : "-";
    const auto* const found = std::ranges::find_if(MeditLists, [&](const MeditList& list)
      { return !group.number && group.name == list.group && list.items == items; });
    return found == MeditLists.end() ? nullptr : found;
  }

  /** Calls `take` with each membership of a facet: its corners and its group, in the order of the
   * file. */
  template <class Take>
  void forEachFacet(Take&& take) const
  {
    this->Info.groups->forEach(GroupOf::Facets,
      [&](std::span<const std::int64_t> corners, GroupSet set, std::int64_t)
      {
        for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Facets))
        {
          take(corners, group);
        }
      });
  }

  /** A facet is written once for each of its groups. */
  void writeFacets()
  {
    const std::int64_t count = this->Info.groups->memberships(GroupOf::Facets);
    if (count == 0)
    {
      return;
    }
    this->Out << this->facetSection() << '\n' << count << '\n';
    this->forEachFacet(
      [this](std::span<const std::int64_t> corners, std::uint32_t group)
      {
        for (const std::int64_t corner : corners)
        {
          this->Out << corner + 1 << ' ';
        }
        const bool isListed = this->listOf(this->Info.groups->groups().groups[group]) != nullptr;
        this->Out << (isListed ? 0 : this->Info.groups->numberOf(group)) << '\n';
      });
  }

  void writeLists()
  {
    const std::vector<Group>& groups = this->Info.groups->groups().groups;
    for (std::uint32_t g = 0; g < groups.size(); ++g)
    {
      const MeditList* const list = this->listOf(groups[g]);
      const std::int64_t count = list ? this->Info.groups->members(g) : 0;
      if (count == 0)
      {
        continue;
      }
      this->Out << list->keyword << '\n' << count << '\n';
      if (groups[g].of == GroupOf::Vertices)
      {
        this->Info.groups->forEach(GroupOf::Vertices,
          [&](std::span<const std::int64_t> vertex, GroupSet set, std::int64_t)
          {
            const auto of = this->Info.groups->groupsOf(set, GroupOf::Vertices);
            if (std::ranges::binary_search(of, g))
            {
              this->Out << vertex[0] + 1 << '\n';
            }
          });
        continue;
      }
      std::int64_t number = 0;
      this->forEachFacet(
        [&](std::span<const std::int64_t>, std::uint32_t group)
        {
          ++number;
          if (group == g)
          {
            this->Out << number << '\n';
          }
        });
    }
  }

  void beginSection()
  {
    if (this->Info.cellType == CellType::Tetrahedron)
    {
      this->Out << "Tetrahedra\n" << this->Info.elements << '\n';
    }
    else if (this->WritesQuadrilaterals)
    {
      this->Out << "Quadrilaterals\n" << this->Info.quadrilaterals << '\n';
    }
    else
    {
      this->Out << "Triangles\n" << this->Triangles << '\n';
    }
  }

  TextOutput Out;
  const MeshFileInfo Info;
  PlacedColumns Columns;
  WrittenLabels OfVertices, OfCells;
  std::int64_t Triangles;
  bool WritesQuadrilaterals; ///< otherwise, of a surface, the triangles
};

} // namespace

std::unique_ptr<MeshFileWriter> makeMeditWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return makeWriter<MeditWriter>(path, info, workspace);
}

std::int64_t bytesOfMedit(const MeshToWrite& written)
{
  constexpr double NoReference = 2;
  const StreamInfo& mesh = written.mesh;
  PlacedColumns columns(mesh);
  const std::ptrdiff_t ofVertices = columns.integerOfVertices({ ReferenceName, MarkerName });
  const std::ptrdiff_t ofCells = columns.integerOfElements({ ReferenceName, PhysicalTagName });
  return textBytes(mesh.vertices, positionCharacters(mesh.doublePositions) +
                                    tupleCharacters(mesh.vertexColumns, ofVertices, NoReference)) +
         textBytes(mesh.cells, cornersOf(mesh.cellType) * numberCharacters(mesh.vertices) +
                                 tupleCharacters(mesh.cellColumns, ofCells, NoReference));
}

} // namespace smg
