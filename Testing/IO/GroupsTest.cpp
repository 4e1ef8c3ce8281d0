// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Selection.h"
#include "Testing/IO/MeshText.h"
#include "Testing/Support/ErrorMessage.h"
#include "Testing/Support/TemporaryFolder.h"
#include "smg/Convert.h"
#include "smg/Error.h"
#include "smg/VsmReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

// Random groups of vertices, facets (on the boundary, in the interior, of no cell) and cells of
// random meshes: what a conversion makes of them, and what is selected by them, against sets.

namespace smg::testing
{
namespace
{

using Entity = std::vector<std::int64_t>; ///< vertices of the file, ascending
using Names = std::set<std::string>;
using Members = std::map<Entity, Names>;

/** A mesh with groups, which are known by what a file says of them. */
struct GroupedMesh
{
  IndexedTestMesh mesh;
  Members vertices, facets, cells;
  std::int64_t elsewhere = 0; ///< facets of no cell
};

Entity sorted(Entity entity)
{
  std::ranges::sort(entity);
  return entity;
}

/** The corners of a cell, without one of them. */
std::vector<Entity> facetsOf(const Entity& cell)
{
  std::vector<Entity> facets;
  for (std::size_t k = 0; k < cell.size(); ++k)
  {
    facets.push_back(cell);
    facets.back().erase(facets.back().begin() + static_cast<std::ptrdiff_t>(k));
  }
  return facets;
}

/** The mesh as a file of Gmsh, each group being elements of its own; and what the file says. */
std::string gmshText(GroupedMesh& grouped, Random& random)
{
  const IndexedTestMesh& mesh = grouped.mesh;
  const bool isSurface = mesh.cellType == CellType::Triangle;
  const auto corners = static_cast<std::size_t>(cornersOf(mesh.cellType));
  const int dimension = isSurface ? 2 : 3;
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n";
  text += std::to_string(dimension - 1) + " 3 \"inlet of air\"\n";
  text += std::to_string(dimension - 1) + " 4 \"wall\"\n0 1 \"probe\"\n";
  text += std::to_string(dimension) + " 3 \"metal\"\n";
  text += std::to_string(dimension) + " 9 \"empty\"\n$EndPhysicalNames\n$Nodes\n";
  text += std::to_string(mesh.vertices()) + '\n';
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    text += std::to_string(v + 1);
    for (std::int64_t axis = 0; axis < 3; ++axis)
    {
      text += ' ' + exact(mesh.positions[static_cast<std::size_t>(3 * v + axis)]);
    }
    text += '\n';
  }
  std::vector<std::string> elements;
  const auto element = [&](std::size_t size, int group, const Entity& entity)
  {
    constexpr int Types[] = { 0, 15, 1, 2, 4 }; // of Gmsh, by the number of corners
    std::string line =
      ' ' + std::to_string(Types[size]) + " 2 " + std::to_string(group) + ' ' + "1";
    for (const std::int64_t v : entity)
    {
      line += ' ' + std::to_string(v + 1);
    }
    elements.push_back(line + '\n');
  };
  for (std::size_t at = 0; at < mesh.corners.size(); at += corners)
  {
    const auto begin = mesh.corners.begin() + static_cast<std::ptrdiff_t>(at);
    const Entity cell(begin, begin + static_cast<std::ptrdiff_t>(corners));
    const int group = std::array{ 0, 3, 5 }[static_cast<std::size_t>(random.below(3))];
    element(corners, group, cell);
    if (group != 0)
    {
      grouped.cells[sorted(cell)].insert(group == 3 ? "metal" : "5");
    }
    for (Entity facet : facetsOf(cell))
    {
      if (random.below(12) == 0)
      {
        const bool isInlet = random.below(2) == 0;
        // In any order of the corners, and perhaps in both groups.
        std::rotate(facet.begin(), facet.begin() + 1, facet.end());
        element(corners - 1, isInlet ? 3 : 4, facet);
        grouped.facets[sorted(facet)].insert(isInlet ? "inlet of air" : "wall");
      }
    }
  }
  for (int k = 0; k < 7; ++k)
  {
    const std::int64_t v = random.below(mesh.vertices());
    element(1, 1, { v });
    grouped.vertices[{ v }].insert("probe");
  }
  // The ends of the mesh share no cell.
  const Entity far = isSurface ? Entity{ 0, mesh.vertices() - 1 }
                               : Entity{ 0, mesh.vertices() / 2, mesh.vertices() - 1 };
  element(corners - 1, 4, far);
  grouped.elsewhere = 1;
  for (std::size_t k = elements.size(); k > 1; --k)
  {
    std::swap(elements[k - 1],
      elements[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(k)))]);
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(elements.size()) + '\n';
  for (std::size_t k = 0; k < elements.size(); ++k)
  {
    text += std::to_string(k + 1) + elements[k];
  }
  return text + "$EndElements\n";
}

/** A mesh stream in memory, with what it says of groups. */
struct Read
{
  explicit Read(const VsmReader& reader)
    : info(reader.info())
  {
    const auto source = reader.source();
    for (MeshBlock block; source->next(block);)
    {
      this->blocks.push_back(block);
    }
    const auto count = static_cast<std::size_t>(cornersOf(this->info.cellType));
    for (const MeshBlock& block : this->blocks)
    {
      for (std::size_t v = 0; v < static_cast<std::size_t>(block.vertices()); ++v)
      {
        this->ids.push_back(columnOf(block.vertexColumns, "OriginalId")->as<std::int64_t>()[v]);
        const std::size_t at = this->ids.size() - 1;
        this->add(this->vertices, block.vertexColumns, VertexGroupsName, v, { this->ids[at] });
      }
      for (std::size_t c = 0; c < block.corners.size() / count; ++c)
      {
        Entity cell;
        for (std::size_t k = 0; k < count; ++k)
        {
          cell.push_back(this->ids[static_cast<std::size_t>(block.corners[c * count + k])]);
        }
        this->add(this->cells, block.cellColumns, CellGroupsName, c, cell);
        const std::vector<Entity> facets = facetsOf(cell);
        for (std::size_t k = 0; k < count; ++k)
        {
          this->add(this->facets, block.cellColumns, FacetGroupsName, c * count + k, facets[k]);
        }
      }
    }
  }

  static const Column* columnOf(const std::vector<Column>& columns, const std::string& name)
  {
    const auto found =
      std::ranges::find_if(columns, [&](const Column& column) { return column.spec.name == name; });
    return found == columns.end() ? nullptr : &*found;
  }

  StreamInfo info;
  std::vector<MeshBlock> blocks;
  std::vector<std::int64_t> ids;
  Members vertices, facets, cells;
  bool isTwice = false; ///< whether a facet has groups in two cells

private:
  void add(Members& members, const std::vector<Column>& columns, const char* name,
    std::size_t place, const Entity& entity)
  {
    const Column* const column = columnOf(columns, name);
    const GroupSet set = column ? column->as<GroupSet>()[place] : GroupSet(0);
    if (set > 0)
    {
      Names& names = members[sorted(entity)];
      this->isTwice = this->isTwice || !names.empty();
      for (const std::uint32_t group : this->info.groups.sets.at(set))
      {
        names.insert(this->info.groups.groups.at(group).label());
      }
    }
  }
};

} // namespace

class Groups : public ::testing::TestWithParam<CellType>
{
protected:
  GroupedMesh make(std::uint64_t seed)
  {
    Random random(seed);
    GroupedMesh grouped;
    grouped.mesh =
      this->GetParam() == CellType::Triangle ? grid(9, 7, 0.2, seed) : tetBox(4, 5, 3, 0.1, seed);
    grouped.mesh = shuffled(grouped.mesh, seed);
    writeBytes(this->Folder / "a.msh", gmshText(grouped, random));
    return grouped;
  }

  TemporaryFolder Folder;
};

TEST_P(Groups, OfAFileAreThoseOfTheStreamInEveryOrder)
{
  for (const std::uint64_t seed : { 1U, 2U, 3U })
  {
    const GroupedMesh grouped = this->make(seed);
    for (const StreamOrder order :
      { StreamOrder::BreadthFirst, StreamOrder::Axis, StreamOrder::Keep, StreamOrder::Spectral })
    {
      ConversionOptions options;
      options.order = order;
      options.orient = seed == 2; // which turns triangles, and their corners
      const ConversionReport report =
        convert(this->Folder / "a.msh", this->Folder / "a.vsm", options);
      const std::string notes =
        std::accumulate(report.notes.begin(), report.notes.end(), std::string(), std::plus<>());
      EXPECT_NE(notes.find("1 element of groups"), std::string::npos) << notes;
      // And once more, from stream to stream.
      convert(this->Folder / "a.vsm", this->Folder / "b.vsm", options);
      for (const char* name : { "a.vsm", "b.vsm" })
      {
        const Read read(VsmReader(this->Folder / name));
        EXPECT_EQ(read.vertices, grouped.vertices);
        EXPECT_EQ(read.facets, grouped.facets);
        EXPECT_EQ(read.cells, grouped.cells);
        EXPECT_FALSE(read.isTwice);
      }
    }
  }
}

namespace
{

/** A random place, and what it selects of an entity. */
class RandomPlace
{
public:
  RandomPlace(Random& random, const Read& mesh, DataPlace place)
    : Chosen(random)
    , Mesh(mesh)
    , Place(place)
  {
  }

  using Selects = std::function<bool(const Entity&)>; ///< of stream indices
  Where make(int depth, Selects& selects)
  {
    const std::int64_t kind = this->Chosen.below(depth > 0 ? 6 : 3);
    if (kind < 2)
    {
      return this->group(selects);
    }
    if (kind == 2)
    {
      const double limit = 1.0 + this->Chosen.uniform();
      selects = [this, limit](const Entity& entity)
      { return std::ranges::all_of(entity, [&](std::int64_t v) { return this->x(v) >= limit; }); };
      return Region(Region::HalfSpace{ { 1, 0, 0 }, limit });
    }
    const auto how = static_cast<Combination::Kind>(kind - 3);
    Combination combined{ how, {} };
    std::vector<Selects> parts(how == Combination::Kind::Not ? 1 : 2);
    for (Selects& part : parts)
    {
      combined.parts.push_back(this->make(depth - 1, part));
    }
    selects = [how, parts](const Entity& entity)
    {
      const auto is = [&](const Selects& part) { return part(entity); };
      return how == Combination::Kind::All   ? std::ranges::all_of(parts, is)
             : how == Combination::Kind::Any ? std::ranges::any_of(parts, is)
                                             : !parts[0](entity);
    };
    return combined;
  }

private:
  double x(std::int64_t vertex) const
  {
    for (const MeshBlock& block : this->Mesh.blocks)
    {
      if (vertex < block.firstVertex + block.vertices())
      {
        return block.positions[static_cast<std::size_t>(3 * (vertex - block.firstVertex))];
      }
    }
    return 0.0;
  }

  Where group(Selects& selects)
  {
    struct Choice
    {
      const char* name;
      GroupOf kind;
    };
    const bool inCells = this->Place == DataPlace::Cells;
    const Choice choices[] = { { "probe", GroupOf::Vertices }, { "metal", GroupOf::Cells },
      { "5", GroupOf::Cells }, { "wall", GroupOf::Facets }, { "inlet*", GroupOf::Facets },
      { "3", GroupOf::Facets } };
    const Choice choice = choices[this->Chosen.below(inCells ? 3 : 6)];
    const std::string name = choice.name == std::string("inlet*") || choice.name == std::string("3")
                               ? "inlet of air"
                               : choice.name;
    const auto inOriginal = [this](const Entity& entity)
    {
      Entity original;
      std::ranges::transform(entity, std::back_inserter(original),
        [this](std::int64_t v) { return this->Mesh.ids[static_cast<std::size_t>(v)]; });
      return sorted(original);
    };
    const Members& members = choice.kind == GroupOf::Vertices ? this->Mesh.vertices
                             : choice.kind == GroupOf::Facets ? this->Mesh.facets
                                                              : this->Mesh.cells;
    selects = [this, &members, name, inOriginal, choice](const Entity& entity)
    {
      const Entity original = inOriginal(entity);
      const auto isIn = [&](const Entity& member)
      {
        const auto found = members.find(member);
        return found != members.end() && found->second.contains(name);
      };
      if (choice.kind == GroupOf::Vertices)
      {
        return std::ranges::all_of(original, [&](std::int64_t v) { return isIn({ v }); });
      }
      const auto size = static_cast<std::size_t>(cornersOf(this->Mesh.info.cellType)) -
                        (choice.kind == GroupOf::Facets ? 1 : 0);
      // A vertex of any member; a facet of a cell, as far as a cell alone tells.
      return original.size() == size ? isIn(original)
                                     : std::ranges::any_of(members,
                                         [&](const auto& member) {
                                           return member.second.contains(name) &&
                                                  std::ranges::includes(member.first, original);
                                         });
    };
    return InGroup{ { choice.name } };
  }

  Random& Chosen;
  const Read& Mesh;
  DataPlace Place;
};

/** The entities of a block that a selection has, by stream indices: vertices, cells, or facets with
 * the cell that says so. */
std::set<Entity> selectedIn(const Read& mesh, const Where& where, DataPlace place,
  const std::filesystem::path& folder, bool mayBeEmpty = true)
{
  MeshColumns columns(mesh.info, "p.json");
  const auto selection = Selection::make(where, place, ColumnOwner::Vertices, "here", columns);
  for (const MeshBlock& block : mesh.blocks)
  {
    selection->prepare(block, folder);
  }
  if (mayBeEmpty)
  {
    selection->acceptEmpty();
  }
  selection->endPreparing(nullptr);
  const auto count = static_cast<std::size_t>(cornersOf(mesh.info.cellType));
  std::set<Entity> found;
  for (const MeshBlock& block : mesh.blocks)
  {
    selection->startBlock(block);
    for (std::size_t v = 0; place == DataPlace::Vertices && v < selection->atVertices().size(); ++v)
    {
      if (selection->atVertices()[v])
      {
        found.insert({ block.firstVertex + static_cast<std::int64_t>(v) });
      }
    }
    std::vector<std::uint8_t> bits(block.corners.size() / count);
    const CellRange cells{ block, 0, block.corners };
    if (place != DataPlace::Vertices)
    {
      place == DataPlace::Cells ? selection->atCells(cells, bits)
                                : selection->atFacets(cells, bits);
    }
    for (std::size_t c = 0; c < bits.size(); ++c)
    {
      const auto begin = block.corners.begin() + static_cast<std::ptrdiff_t>(c * count);
      const Entity cell(begin, begin + static_cast<std::ptrdiff_t>(count));
      if (place == DataPlace::Cells && bits[c])
      {
        found.insert(sorted(cell));
      }
      for (std::size_t k = 0; place == DataPlace::Facets && k < count; ++k)
      {
        if ((bits[c] >> k & 1) != 0)
        {
          found.insert(sorted(facetsOf(cell)[k]));
        }
      }
    }
  }
  return found;
}

} // namespace

/** Facets are compared on the boundary, where a cell alone knows them. */
TEST_P(Groups, AndCombinationsSelectWhatSetsSay)
{
  Random random(5);
  int selected = 0;
  for (const std::uint64_t seed : { 4U, 5U })
  {
    this->make(seed);
    convert(this->Folder / "a.msh", this->Folder / "a.vsm");
    const Read mesh(VsmReader(this->Folder / "a.vsm"));
    std::map<Entity, int> cellsOfFacet;
    std::set<Entity> all[3];
    const auto count = static_cast<std::ptrdiff_t>(cornersOf(mesh.info.cellType));
    for (const MeshBlock& block : mesh.blocks)
    {
      for (auto at = block.corners.begin(); at != block.corners.end(); at += count)
      {
        const Entity cell = sorted(Entity(at, at + count));
        all[int(DataPlace::Cells)].insert(cell);
        for (const Entity& facet : facetsOf(cell))
        {
          ++cellsOfFacet[facet];
        }
        for (const std::int64_t v : cell)
        {
          all[int(DataPlace::Vertices)].insert({ v });
        }
      }
    }
    for (const auto& [facet, cells] : cellsOfFacet)
    {
      if (cells == 1)
      {
        all[int(DataPlace::Facets)].insert(facet);
      }
    }
    for (int k = 0; k < 60; ++k)
    {
      const auto place = static_cast<DataPlace>(random.below(3));
      RandomPlace made(random, mesh, place);
      RandomPlace::Selects selects;
      const Where where = made.make(2, selects);
      std::set<Entity> expected;
      std::ranges::copy_if(
        all[int(place)], std::inserter(expected, expected.end()), std::ref(selects));
      std::set<Entity> found;
      // A part that selects nothing is an error, not what is tested here.
      const std::string error =
        messageOf([&] { found = selectedIn(mesh, where, place, this->Folder.path()); });
      if (!error.empty())
      {
        EXPECT_NE(error.find("no "), std::string::npos) << error;
        continue;
      }
      std::set<Entity> compared;
      std::ranges::set_intersection(
        found, all[int(place)], std::inserter(compared, compared.end()));
      EXPECT_EQ(compared, expected) << "place " << int(place) << ", number " << k;
      selected += expected.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(selected, 40);
}

TEST_P(Groups, AnUnknownNameListsThoseThatThereAre)
{
  this->make(1);
  convert(this->Folder / "a.msh", this->Folder / "a.vsm");
  const Read mesh(VsmReader(this->Folder / "a.vsm"));
  const auto error = [&](const char* name, DataPlace place)
  {
    return messageOf(
      [&] { selectedIn(mesh, InGroup{ { name } }, place, this->Folder.path(), false); });
  };
  EXPECT_EQ(error("walls", DataPlace::Facets),
    "p.json: here.group: the mesh has no group 'walls'; it has 'wall', '5', 'empty', 'metal', "
    "'probe' and 'inlet of air'.");
  EXPECT_EQ(error("wall", DataPlace::Cells),
    "p.json: here.group: the group 'wall' is of facets, but cells are needed here.");
  EXPECT_EQ(
    error("empty", DataPlace::Cells), "p.json: here: no cell of the mesh is in the group 'empty'.");
}

INSTANTIATE_TEST_SUITE_P(OfCells, Groups,
  ::testing::Values(CellType::Triangle, CellType::Tetrahedron),
  [](const auto& info) { return info.param == CellType::Triangle ? "Triangles" : "Tetrahedra"; });

} // namespace smg::testing
