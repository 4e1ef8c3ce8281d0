// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Exodus/ExodusWriter.h"

#include "IO/Export/GroupElements.h"
#include "IO/Export/GroupSides.h"
#include "IO/Export/PlacedColumns.h"
#include "IO/Files/FileNames.h"
#include "IO/Formats/Exodus/NetCdfLayout.h"
#include "IO/Formats/Exodus/VariableOutput.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

// Exodus II ("EXODUS II: A Finite Element Data Model", SAND92-2137), as a classic netCDF file.
// Elements come twice: first they are counted, which gives the blocks and side sets their sizes and
// all variables their places; then they are written there. A block is what is in the same first
// group of cells and has the same shape. Components of columns are variables of one time step.
//
// Memory: what waits to be written at its place, of all variables together, has a bound.

namespace smg
{
namespace
{

using Type = NetCdfLayout::Type;

/** A component of a column. */
struct ExodusResult
{
  std::size_t column;
  std::size_t component;
  std::string name;
  Type type;
};

/** The name of a component, as other programs join them to vectors and tensors. */
std::string componentName(const ColumnSpec& spec, int component)
{
  constexpr std::array Axes{ "x", "y", "z" };
  const std::string base = spec.name + '_';
  return spec.components == 1   ? spec.name
         : spec.components == 3 ? base + Axes[std::size_t(component)]
         : spec.components == 9
           ? base + Axes[std::size_t(component) / 3] + Axes[std::size_t(component) % 3]
           : base + std::to_string(component + 1);
}

std::vector<ExodusResult> resultsOf(
  const std::vector<ColumnSpec>& specs, const std::vector<std::size_t>& places)
{
  std::vector<ExodusResult> results;
  for (const std::size_t place : places)
  {
    for (int k = 0; k < specs[place].components; ++k)
    {
      results.push_back({ place, static_cast<std::size_t>(k), componentName(specs[place], k),
        specs[place].type == ScalarType::Float32 ? Type::Float : Type::Double });
    }
  }
  return results;
}

double valueOf(const std::vector<Column>& columns, const ExodusResult& result, std::size_t tuple)
{
  const Column& column = columns[result.column];
  return dispatch(column.spec.type,
    [&]<class T>(T)
    {
      return static_cast<double>(
        column.as<T>()[tuple * std::size_t(column.spec.components) + result.component]);
    });
}

class ExodusMeshWriter : public MeshFileWriter
{
public:
  ExodusMeshWriter(
    const std::filesystem::path& path, const MeshFileInfo& info, Workspace& workspace)
    : Path(path)
    , Info(info)
    , Space(workspace)
    , Columns(info)
    , Sets(this->Columns.integerOfElements({ CellGroupsName }))
    , Out(path)
  {
    this->Columns.integerOfVertices({ VertexGroupsName });
    this->Sides.emplace(info, this->Columns, workspace);
    constexpr int Any = INT32_MAX;
    this->NodeResults = resultsOf(info.vertexColumns, this->Columns.othersOfVertices(Any));
    this->ElementResults = resultsOf(info.elementColumns, this->Columns.othersOfElements(Any));
    this->Sets = info.groups ? this->Sets : -1;
  }

  void elements(const ElementChunk& chunk) override
  {
    this->Sides->forEach(chunk, 4,
      [&](std::span<const std::int64_t> corners, std::size_t element,
        std::span<const GroupSides::Side> sides)
      {
        Block& block = this->blockOf(chunk, element, corners.size());
        this->IsPlaced ? this->write(block, chunk, element, corners, sides)
                       : this->count(block, sides);
      });
  }

  bool needsElementsAgain() override
  {
    if (this->IsPlaced)
    {
      return false;
    }
    this->Sides->note(this->Notes);
    this->Sides.emplace(this->Info, this->Columns, this->Space);
    this->layOut();
    return true;
  }

  void vertices(const VertexChunk& chunk) override
  {
    chunk.forEach(
      [&](std::span<const double, 3> position, std::size_t vertex)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          this->Out.put(this->Coordinates[axis], position[axis]);
        }
        for (std::size_t r = 0; r < this->NodeResults.size(); ++r)
        {
          this->Out.put(this->NodeValues[r], valueOf(chunk.columns, this->NodeResults[r], vertex));
        }
      });
  }

  WriteNotes finish() override
  {
    if (this->Info.groups)
    {
      this->Info.groups->forEach(GroupOf::Vertices,
        [&](std::span<const std::int64_t> vertex, GroupSet set, std::int64_t)
        {
          for (const std::uint32_t group : this->Info.groups->groupsOf(set, GroupOf::Vertices))
          {
            this->Out.put(this->NodeSets.at(group).numbers, vertex[0] + 1);
          }
        });
    }
    this->Out.finish(this->Layout.header());
    WriteNotes notes = this->Columns.leftOut(".e");
    notes.insert(notes.end(), this->Notes.begin(), this->Notes.end());
    if (this->InSeveral > 0)
    {
      notes.push_back(counted(this->InSeveral, "cell is", "cells are") +
                      " in several groups, of which the file has the first one.");
    }
    if (this->Blocks.size() > 1)
    {
      notes.emplace_back("The cells are in the order of their blocks, as the format has it.");
    }
    return notes;
  }

private:
  /** Elements of a group, or of none, with so many corners. */
  struct Block
  {
    std::int64_t elements = 0;
    std::int64_t next = 0; ///< number of the next element in the file, from 1
    std::size_t connect = 0;
    std::vector<std::size_t> values; ///< variables of the results
  };
  using BlockKey = std::pair<std::uint32_t, std::size_t>;
  struct SideSet
  {
    std::int64_t sides = 0;
    std::size_t elements = 0, numbers = 0;
  };
  struct NodeSet
  {
    std::size_t numbers;
  };
  static constexpr std::uint32_t NoGroup = UINT32_MAX;
  static constexpr std::size_t LongestName = 255;

  Block& blockOf(const ElementChunk& chunk, std::size_t element, std::size_t corners)
  {
    std::uint32_t group = NoGroup;
    if (this->Sets >= 0)
    {
      const GroupSet set =
        chunk.columns[static_cast<std::size_t>(this->Sets)].as<GroupSet>()[element];
      const auto groups = this->Info.groups->groupsOf(set, GroupOf::Cells);
      this->InSeveral += groups.size() > 1 && this->IsPlaced ? 1 : 0;
      group = groups.empty() ? NoGroup : groups.front();
    }
    return this->Blocks[{ group, corners }];
  }

  void count(Block& block, std::span<const GroupSides::Side> sides)
  {
    ++block.elements;
    for (const GroupSides::Side& side : sides)
    {
      for (const std::uint32_t group : this->Info.groups->groupsOf(side.set, GroupOf::Facets))
      {
        ++this->SideSets[group].sides;
      }
    }
  }

  /** The number of a side in the file. Triangles are shells, whose sides 1 and 2 are their faces.
   */
  std::int64_t sideNumber(std::size_t side) const
  {
    constexpr std::array<std::int64_t, 4> OfTetrahedron{ 2, 3, 1, 4 };
    return this->Info.cellType == CellType::Tetrahedron ? OfTetrahedron[side]
                                                        : static_cast<std::int64_t>(side) + 3;
  }

  void write(Block& block, const ElementChunk& chunk, std::size_t element,
    std::span<const std::int64_t> corners, std::span<const GroupSides::Side> sides)
  {
    const std::int64_t number = block.next++;
    for (const std::int64_t corner : corners)
    {
      this->Out.put(block.connect, corner + 1);
    }
    for (std::size_t r = 0; r < this->ElementResults.size(); ++r)
    {
      this->Out.put(block.values[r], valueOf(chunk.columns, this->ElementResults[r], element));
    }
    for (const GroupSides::Side& side : sides)
    {
      for (const std::uint32_t group : this->Info.groups->groupsOf(side.set, GroupOf::Facets))
      {
        const SideSet& set = this->SideSets.at(group);
        this->Out.put(set.elements, number);
        this->Out.put(set.numbers, this->sideNumber(side.number));
      }
    }
  }

  /** Numbers of blocks or sets: those of groups where these are from 1 on, and different. */
  std::vector<std::int64_t> numbersOf(const std::vector<std::uint32_t>& groups) const
  {
    std::set<std::int64_t> taken;
    std::vector<std::int64_t> numbers;
    for (const std::uint32_t group : groups)
    {
      const std::int64_t own = group == NoGroup ? 0 : this->Info.groups->numberOf(group);
      const bool isFree = own > 0 && own <= INT32_MAX && taken.insert(own).second;
      numbers.push_back(isFree ? own : 0);
    }
    std::int64_t next = 1;
    for (std::int64_t& number : numbers)
    {
      for (; number == 0 && !taken.insert(next).second; ++next)
      {
      }
      number = number == 0 ? next : number;
    }
    return numbers;
  }
  std::string nameOf(std::uint32_t group) const
  {
    return group == NoGroup ? std::string()
                            : this->Info.groups->groups().groups[group].name.substr(0, LongestName);
  }

  /** The groups of this kind that have members, with how many these are. */
  std::vector<std::uint32_t> nodeGroups() const
  {
    std::vector<std::uint32_t> groups;
    for (std::uint32_t g = 0; this->Info.groups && g < this->Info.groups->groups().groups.size();
         ++g)
    {
      if (this->Info.groups->groups().groups[g].of == GroupOf::Vertices &&
          this->Info.groups->members(g) > 0)
      {
        groups.push_back(g);
      }
    }
    return groups;
  }

  /** Adds a variable, which is written as soon as all have their places. */
  void add(const std::string& name, Type type, const std::vector<int>& dimensions,
    const std::function<void(std::size_t)>& begun, const NetCdfLayout::Texts& attributes = {})
  {
    this->Added.emplace_back(this->Layout.variable(name, type, dimensions, attributes), begun);
  }

  /** A list of integers that is known, and of names. */
  void addNumbers(const std::string& name, const std::vector<int>& dimensions,
    std::vector<std::int64_t> values, const NetCdfLayout::Texts& attributes = {})
  {
    this->add(
      name, Type::Int, dimensions,
      [this, values = std::move(values)](std::size_t variable)
      {
        for (const std::int64_t value : values)
        {
          this->Out.put(variable, value);
        }
      },
      attributes);
  }
  void addNames(const std::string& name, int count, std::vector<std::string> names)
  {
    this->add(name, Type::Char, { count, this->NameDimension },
      [this, names = std::move(names)](std::size_t variable)
      {
        for (const std::string& each : names)
        {
          this->Out.put(variable, each, this->NameBytes);
        }
      });
  }
  /** Numbers, states and names of the blocks or of the sets of a kind. */
  void addList(const std::string& prefix, int count, const std::vector<std::uint32_t>& groups)
  {
    std::vector<std::string> names;
    std::ranges::transform(groups, std::back_inserter(names),
      [this](std::uint32_t group) { return this->nameOf(group); });
    this->addNumbers(prefix + "_status", { count }, std::vector<std::int64_t>(groups.size(), 1));
    this->addNumbers(prefix + "_prop1", { count }, this->numbersOf(groups), { { "name", "ID" } });
    this->addNames(prefix + "_names", count, std::move(names));
  }

  void layOut()
  {
    this->IsPlaced = true;
    this->addHead();
    this->addBlocks();
    this->addSets();
    this->addResults();
    constexpr std::size_t Most = 100000; // that this program reads
    if (this->Layout.variables() > Most)
    {
      throw Error(this->Path.string() + ": would have " + std::to_string(this->Layout.variables()) +
                  " variables, but may have " + std::to_string(Most) +
                  ": leave out columns, or take another format.");
    }
    this->Layout.place();
    for (const auto& [variable, begun] : this->Added)
    {
      begun(this->Out.begin(this->Layout.beginOf(variable), this->Layout.typeOf(variable)));
    }
    this->Added.clear();
  }

  std::size_t longestName() const
  {
    std::size_t longest = 32;
    const auto consider = [&longest](const std::string& name)
    { longest = std::clamp(name.size(), longest, LongestName); };
    if (this->Info.groups)
    {
      std::ranges::for_each(this->Info.groups->groups().groups, consider, &Group::name);
    }
    std::ranges::for_each(this->NodeResults, consider, &ExodusResult::name);
    std::ranges::for_each(this->ElementResults, consider, &ExodusResult::name);
    return longest;
  }

  void addHead()
  {
    const std::size_t longest = this->longestName();
    this->NameBytes = longest + 1;
    this->IndexType =
      std::max(this->Info.vertices, this->Info.cells) > INT32_MAX ? Type::Int64 : Type::Int;
    constexpr float Version = 8.03F;
    NetCdfLayout& layout = this->Layout;
    layout.attribute("api_version", Version);
    layout.attribute("version", Version);
    layout.attribute("floating_point_word_size", this->Info.doublePositions ? 8 : 4);
    layout.attribute("file_size", 1);
    layout.attribute("maximum_name_length", static_cast<std::int32_t>(longest));
    constexpr std::int32_t LargeNumbers = 0x1000;
    layout.attribute("int64_status", this->IndexType == Type::Int64 ? LargeNumbers : 0);
    layout.attribute("title", std::string("mesh"));
    layout.dimension("len_string", 33);
    layout.dimension("len_line", 81);
    layout.dimension("four", 4);
    this->NameDimension = layout.dimension("len_name", static_cast<std::int64_t>(this->NameBytes));
    const bool hasResults = !this->NodeResults.empty() || !this->ElementResults.empty();
    this->TimeDimension = layout.records("time_step", hasResults ? 1 : 0);
    const int axes = layout.dimension("num_dim", 3);
    this->NodeDimension = layout.dimension("num_nodes", this->Info.vertices);
    const Type real = this->Info.doublePositions ? Type::Double : Type::Float;
    for (const char* name : { "coordx", "coordy", "coordz" })
    {
      this->add(name, real, { this->NodeDimension },
        [this](std::size_t variable) { this->Coordinates.push_back(variable); });
    }
    this->addNames("coor_names", axes, { "x", "y", "z" });
    this->add("time_whole", Type::Double, { this->TimeDimension },
      [this, hasResults](std::size_t variable)
      {
        if (hasResults)
        {
          this->Out.put(variable, 0.0);
        }
      });
  }

  void addBlocks()
  {
    std::int64_t elements = 0;
    std::vector<std::uint32_t> groups;
    for (auto& [key, block] : this->Blocks)
    {
      groups.push_back(key.first);
      block.next = elements + 1;
      elements += block.elements;
    }
    this->Layout.dimension("num_elem", elements);
    this->BlockDimension = this->Layout.dimension("num_el_blk", std::ssize(this->Blocks));
    this->addList("eb", this->BlockDimension, groups);
    int k = 0;
    for (auto& [key, block] : this->Blocks)
    {
      const std::string index = std::to_string(++k);
      this->BlockDimensions.push_back(
        this->Layout.dimension("num_el_in_blk" + index, block.elements));
      const int corners =
        this->Layout.dimension("num_nod_per_el" + index, static_cast<std::int64_t>(key.second));
      const char* const shape = this->Info.cellType == CellType::Tetrahedron ? "TETRA"
                                : key.second == 4                            ? "QUAD4"
                                                                             : "TRI3";
      this->add("connect" + index, this->IndexType, { this->BlockDimensions.back(), corners },
        [&block](std::size_t variable) { block.connect = variable; }, { { "elem_type", shape } });
    }
  }

  void addSets()
  {
    const std::vector<std::uint32_t> ofNodes = this->nodeGroups();
    if (!ofNodes.empty())
    {
      this->addList("ns", this->Layout.dimension("num_node_sets", std::ssize(ofNodes)), ofNodes);
      for (std::size_t k = 0; k < ofNodes.size(); ++k)
      {
        const std::string index = std::to_string(k + 1);
        const int nodes =
          this->Layout.dimension("num_nod_ns" + index, this->Info.groups->members(ofNodes[k]));
        this->add("node_ns" + index, this->IndexType, { nodes },
          [this, group = ofNodes[k]](std::size_t variable)
          { this->NodeSets[group] = { variable }; });
      }
    }
    if (this->SideSets.empty())
    {
      return;
    }
    std::vector<std::uint32_t> groups;
    for (const auto& [group, set] : this->SideSets)
    {
      groups.push_back(group);
    }
    this->addList("ss", this->Layout.dimension("num_side_sets", std::ssize(groups)), groups);
    int k = 0;
    for (auto& [group, set] : this->SideSets)
    {
      const std::string index = std::to_string(++k);
      const int sides = this->Layout.dimension("num_side_ss" + index, set.sides);
      this->add("elem_ss" + index, this->IndexType, { sides },
        [&set](std::size_t variable) { set.elements = variable; });
      this->add("side_ss" + index, this->IndexType, { sides },
        [&set](std::size_t variable) { set.numbers = variable; });
    }
  }

  static std::vector<std::string> namesOf(const std::vector<ExodusResult>& results)
  {
    std::vector<std::string> names;
    std::ranges::transform(results, std::back_inserter(names),
      [](const ExodusResult& result) { return result.name.substr(0, LongestName); });
    return names;
  }

  void addResults()
  {
    if (!this->NodeResults.empty())
    {
      this->addNames("name_nod_var",
        this->Layout.dimension("num_nod_var", std::ssize(this->NodeResults)),
        namesOf(this->NodeResults));
      for (std::size_t r = 0; r < this->NodeResults.size(); ++r)
      {
        this->add("vals_nod_var" + std::to_string(r + 1), this->NodeResults[r].type,
          { this->TimeDimension, this->NodeDimension },
          [this](std::size_t variable) { this->NodeValues.push_back(variable); });
      }
    }
    if (this->ElementResults.empty())
    {
      return;
    }
    const int results = this->Layout.dimension("num_elem_var", std::ssize(this->ElementResults));
    this->addNames("name_elem_var", results, namesOf(this->ElementResults));
    this->addNumbers("elem_var_tab", { this->BlockDimension, results },
      std::vector<std::int64_t>(this->Blocks.size() * this->ElementResults.size(), 1));
    for (std::size_t r = 0; r < this->ElementResults.size(); ++r)
    {
      std::size_t k = 0;
      for (auto& [key, block] : this->Blocks)
      {
        this->add("vals_elem_var" + std::to_string(r + 1) + "eb" + std::to_string(k + 1),
          this->ElementResults[r].type, { this->TimeDimension, this->BlockDimensions[k] },
          [&block](std::size_t variable) { block.values.push_back(variable); });
        ++k;
      }
    }
  }

  std::filesystem::path Path;
  const MeshFileInfo Info;
  Workspace& Space;
  PlacedColumns Columns;
  std::ptrdiff_t Sets; ///< column of cells; -1: there is none
  std::optional<GroupSides> Sides;
  std::vector<ExodusResult> NodeResults, ElementResults;
  NetCdfLayout Layout;
  VariableOutput Out;
  std::vector<std::pair<int, std::function<void(std::size_t)>>> Added; ///< that have no place yet
  std::map<BlockKey, Block> Blocks;
  std::map<std::uint32_t, SideSet> SideSets; ///< by groups
  std::map<std::uint32_t, NodeSet> NodeSets;
  std::vector<std::size_t> Coordinates, NodeValues; ///< variables
  std::size_t NameBytes = 0;
  Type IndexType = Type::Int;
  int NameDimension = 0, TimeDimension = 0, NodeDimension = 0, BlockDimension = 0;
  std::vector<int> BlockDimensions;
  WriteNotes Notes;
  std::int64_t InSeveral = 0; ///< cells in several groups
  bool IsPlaced = false;
};

} // namespace

std::unique_ptr<MeshFileWriter> makeExodusWriter(
  const std::filesystem::path& path, const MeshFileInfo& info, Workspace* workspace)
{
  return std::make_unique<ExodusMeshWriter>(path, info, *workspace);
}

std::int64_t bytesOfExodus(const MeshToWrite& written)
{
  constexpr std::int64_t IndexBytes = 4;
  const StreamInfo& mesh = written.mesh;
  const auto rowBytes = [](const std::vector<ColumnSpec>& columns)
  {
    std::int64_t bytes = 0;
    for (const ColumnSpec& column : columns)
    {
      bytes += column.components * (column.type == ScalarType::Float32 ? 4 : 8);
    }
    return bytes;
  };
  return mesh.vertices * (positionBytes(mesh) + rowBytes(mesh.vertexColumns)) +
         mesh.cells * (cornersOf(mesh.cellType) * IndexBytes + rowBytes(mesh.cellColumns));
}

} // namespace smg
