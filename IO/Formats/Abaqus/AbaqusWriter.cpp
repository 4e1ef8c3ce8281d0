// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Abaqus/AbaqusWriter.h"

#include "IO/Export/GroupSides.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/FileNames.h"
#include "IO/Files/TextOutput.h"
#include "IO/Formats/Abaqus/AbaqusLines.h"
#include "IO/Formats/Abaqus/AbaqusShapes.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Sets are written as their members come, so that only some are held: a set that is written again
// grows. Surfaces name a set of elements for each of their sides, as Abaqus/CAE writes them.

namespace smg
{
namespace
{

/** The names of groups as those of sets: letters, digits and some signs, of at most 80 characters,
 * which differ in any spelling. */
std::vector<std::string> abaqusNames(const std::vector<Group>& groups, WriteNotes& notes)
{
  constexpr std::size_t Longest = 72;
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const Group& group : groups)
  {
    std::string base = group.label().substr(0, Longest);
    for (char& c : base)
    {
      const bool isSign = c == ',' || c == '"' || c == '=' || c == '*' || c == '.' ||
                          static_cast<unsigned char>(c) < ' ';
      c = isSign ? '_' : c;
    }
    if (base.empty() || base[0] < 'A')
    {
      base = (group.of == GroupOf::Cells ? "E" : group.of == GroupOf::Facets ? "S" : "N") + base;
    }
    std::string name = base;
    const char kind = group.of == GroupOf::Vertices ? 'N' : group.of == GroupOf::Facets ? 'S' : 'E';
    for (int k = 1; !taken.insert(kind + upperCase(name)).second; ++k)
    {
      name = base + '_' + std::to_string(k);
    }
    if (name != group.label())
    {
      notes.push_back(
        "The group " + inQuotes(group.label()) + " is called " + inQuotes(name) + " in the file.");
    }
    names.push_back(name.find(' ') == std::string::npos ? name : '"' + name + '"');
  }
  return names;
}

std::string withoutQuotes(const std::string& name)
{
  return name.starts_with('"') ? name.substr(1, name.size() - 2) : name;
}

class AbaqusMeshWriter : public MeshFileWriter
{
public:
  AbaqusMeshWriter(
    const std::filesystem::path& path, const MeshFileInfo& info, Workspace& workspace)
    : Out(path)
    , Info(info)
    , Columns(info)
    , Cells(this->Columns.integerOfElements({ CellGroupsName }))
    , Sides(info, this->Columns, workspace)
    , Names(abaqusNames(this->groups(), this->Notes))
  {
    this->Columns.integerOfVertices({ VertexGroupsName });
    this->Out << "*HEADING\nmesh\n*NODE\n";
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        this->Out << chunk.first + static_cast<std::int64_t>(vertex) + 1;
        for (const double coordinate : position)
        {
          this->Out << ", ";
          this->Info.doublePositions ? this->Out << coordinate
                                     : this->Out << static_cast<float>(coordinate);
        }
        this->Out << '\n';
      });
  }

  void elements(const ElementChunk& chunk) override
  {
    if (this->WritesSets)
    {
      this->writeSets(chunk);
      return;
    }
    chunk.forEachUpTo(4,
      [&](std::span<const std::int64_t> corners, std::size_t)
      {
        const char* const type = this->Info.cellType == CellType::Tetrahedron ? "C3D4"
                                 : corners.size() == 4                        ? "S4"
                                                                              : "S3";
        if (type != this->Type)
        {
          this->Type = type;
          this->Out << "*ELEMENT, TYPE=" << type << '\n';
        }
        this->Out << ++this->Elements;
        for (const std::int64_t corner : corners)
        {
          this->Out << ", " << corner + 1;
        }
        this->Out << '\n';
      });
  }

  bool needsElementsAgain() override
  {
    const bool again = !this->WritesSets && this->Info.groups &&
                       (this->Cells >= 0 || this->Info.groups->memberships(GroupOf::Facets) > 0);
    this->WritesSets = true;
    this->Elements = 0;
    return again;
  }

  WriteNotes finish() override
  {
    this->writeNodeSets();
    std::uint32_t last = NoIndex;
    for (const auto& [group, side] : this->Surfaces)
    {
      if (group != last)
      {
        this->Out << "*SURFACE, NAME=" << this->Names[group] << ", TYPE=ELEMENT\n";
        last = group;
      }
      this->Out << this->setOf(group, side) << ", " << this->faceOf(side) << '\n';
    }
    this->Out.finish();
    WriteNotes notes = this->Columns.leftOut(".inp");
    notes.insert(notes.end(), this->Notes.begin(), this->Notes.end());
    this->Sides.note(notes);
    return notes;
  }

private:
  /** Labels of nodes or elements, by their group and, of facets, side from 1 on. */
  using Member = std::pair<std::uint32_t, std::uint32_t>;
  using Members = std::map<Member, std::vector<std::int64_t>>;

  std::vector<Group> groups() const
  {
    return this->Info.groups ? this->Info.groups->groups().groups : std::vector<Group>();
  }
  const char* faceOf(std::uint32_t side) const
  {
    return abaqusFaceName(this->Info.cellType == CellType::Tetrahedron, side - 1);
  }
  /** The set of elements of a side of a surface. */
  std::string setOf(std::uint32_t group, std::uint32_t side) const
  {
    const std::string name = '_' + withoutQuotes(this->Names[group]) + '_' + this->faceOf(side);
    return this->Names[group].starts_with('"') ? '"' + name + '"' : name;
  }

  /** Labels of elements count on, since polygons may have become triangles. */
  void writeSets(const ElementChunk& chunk)
  {
    Members members;
    this->Sides.forEach(chunk, 4,
      [&](
        std::span<const std::int64_t>, std::size_t element, std::span<const GroupSides::Side> sides)
      {
        ++this->Elements;
        if (this->Cells >= 0)
        {
          const GroupSet set =
            chunk.columns[static_cast<std::size_t>(this->Cells)].as<GroupSet>()[element];
          for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Cells))
          {
            members[{ group, 0 }].push_back(this->Elements);
          }
        }
        for (const GroupSides::Side& side : sides)
        {
          for (const std::uint32_t group : this->Info.groups->groupsOf(side.set, GroupOf::Facets))
          {
            const Member member{ group, static_cast<std::uint32_t>(side.number) + 1 };
            members[member].push_back(this->Elements);
            this->Surfaces.insert(member);
          }
        }
      });
    this->write(members);
  }

  void writeNodeSets()
  {
    if (!this->Info.groups)
    {
      return;
    }
    constexpr std::size_t MostHeld = std::size_t(64) << 10;
    Members members;
    std::size_t held = 0;
    this->Info.groups->forEach(GroupOf::Vertices,
      [&](std::span<const std::int64_t> vertex, GroupSet set, std::int64_t)
      {
        for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Vertices))
        {
          members[{ group, 0 }].push_back(vertex[0] + 1);
          ++held;
        }
        if (held > MostHeld)
        {
          this->write(members);
          members.clear();
          held = 0;
        }
      });
    this->write(members);
  }

  void write(const Members& members)
  {
    for (const auto& [member, labels] : members)
    {
      const auto& [group, side] = member;
      const bool ofNodes = this->Info.groups->groups().groups[group].of == GroupOf::Vertices;
      this->Out << (ofNodes ? "*NSET, NSET=" : "*ELSET, ELSET=")
                << (side > 0 ? this->setOf(group, side) : this->Names[group])
                << (side > 0 ? ", INTERNAL\n" : "\n");
      constexpr std::size_t AtOnce = 16; // the most that a line may have
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        this->Out << (i == 0 ? "" : i % AtOnce == 0 ? ",\n" : ", ") << labels[i];
      }
      this->Out << '\n';
    }
  }

  TextOutput Out;
  const MeshFileInfo Info;
  PlacedColumns Columns;
  std::ptrdiff_t Cells; ///< column of their sets; -1: there is none
  GroupSides Sides;
  WriteNotes Notes;
  std::vector<std::string> Names; ///< of the groups
  std::set<Member> Surfaces;      ///< and their sides
  std::string_view Type;          ///< of the last elements
  std::int64_t Elements = 0;
  bool WritesSets = false;
};

} // namespace

std::unique_ptr<MeshFileWriter> makeAbaqusWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return std::make_unique<AbaqusMeshWriter>(path, info, *workspace);
}

std::int64_t bytesOfAbaqus(const MeshToWrite& written)
{
  const StreamInfo& mesh = written.mesh;
  constexpr double Comma = 1;
  return textBytes(mesh.vertices,
           numberCharacters(mesh.vertices) + positionCharacters(mesh.doublePositions) + 3 * Comma) +
         textBytes(
           mesh.cells, numberCharacters(mesh.cells) +
                         cornersOf(mesh.cellType) * (numberCharacters(mesh.vertices) + Comma));
}

} // namespace smg
