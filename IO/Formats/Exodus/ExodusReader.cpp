// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Formats/Exodus/ExodusReader.h"

#include "IO/Files/FileNames.h"
#include "IO/Files/InputFile.h"
#include "IO/Formats/Exodus/ExodusShapes.h"
#include "IO/Formats/Vtk/VtkArrayReader.h"
#include "IO/Formats/Vtk/VtkCellReader.h"
#include "IO/Import/ImportColumn.h"
#include "IO/Import/ListedElements.h"
#include "IO/Import/RawMeshBuilder.h"
#include "IO/Mesh/Columns.h"
#include "Solver/Core/Text.h"
#include "smg/Error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

// Exodus II ("EXODUS II: A Finite Element Data Model", SAND92-2137): coordinates, blocks of
// elements of one type each, sets of nodes and of sides by the numbers of nodes and elements from 1
// on, and results by time step, each a variable of a netCDF file.

namespace smg
{
namespace
{

class ExodusMeshReader
{
public:
  ExodusMeshReader(InputFile& file, const NetCdfVariables& variables, RawMeshBuilder& builder)
    : File(file)
    , Variables(variables)
    , Builder(builder)
    , Space(builder.workspace())
    , Listed(builder.workspace())
  {
  }

  void read(const MeshPart& part)
  {
    this->chooseStep(part);
    this->Coordinates = this->coordinates();
    this->Nodes = this->Coordinates.front().values;
    this->declareColumns();
    if (!this->Builder.looks())
    {
      this->readNodes();
    }
    this->Builder.numberVertices(1, this->Nodes);
    if (!this->Builder.looks())
    {
      this->readNodeSets();
      this->readSideSets();
    }
    this->readBlocks();
    if (!this->Builder.looks())
    {
      this->finishSides();
      this->fillColumns();
    }
  }

private:
  struct Block
  {
    VtkArray connect;
    std::int64_t elements = 0, nodes = 0; ///< nodes of an element
    std::optional<ExodusShape> shape;
    std::string type;
    std::int64_t number = 0;
    std::string name;
  };
  struct Result
  {
    std::string name;
    std::size_t index; ///< from 1 on
    ImportColumn column;
    ScalarType type;
  };

  [[noreturn]] void fail(const std::string& sentence) const
  {
    throw Error(this->File.name() + ": " + sentence + '.');
  }

  void chooseStep(const MeshPart& part)
  {
    const NetCdfVariable* const times = this->Variables.find("time_whole");
    const std::int64_t steps = times && !times->extents.empty() ? times->extents[0] : 0;
    if (part.partition)
    {
      this->fail("the file has no partitions (option --partition)");
    }
    if (part.timeStep < 0 || part.timeStep >= std::max<std::int64_t>(steps, 1))
    {
      this->fail(steps == 0
                   ? "the file has no time steps (option --time-step)"
                   : "there is no time step " + std::to_string(part.timeStep) + ": the file has " +
                       std::to_string(steps) + ", counted from 0 (option --time-step)");
    }
    this->Step = part.timeStep;
    this->Steps = steps;
    this->Builder.noteParts(steps, 0);
    if (steps > 1)
    {
      this->Builder.note(
        "The file has " + std::to_string(steps) + " time steps, of which " +
        (this->Step == 0 ? std::string("the first")
                         : "number " + std::to_string(this->Step) + ", counted from 0,") +
        " is read.");
    }
  }

  /** The arrays of x, y and perhaps z. */
  std::vector<VtkArray> coordinates()
  {
    std::vector<VtkArray> arrays;
    if (const NetCdfVariable* all = this->Variables.find("coord"); all && all->extents.size() == 2)
    {
      for (std::int64_t axis = 0; axis < std::min<std::int64_t>(all->extents[0], 3); ++axis)
      {
        arrays.push_back(all->range(axis * all->extents[1], all->extents[1]));
      }
    }
    for (const char* name : { "coordx", "coordy", "coordz" })
    {
      const NetCdfVariable* const axis = this->Variables.find(name);
      if (axis && axis->extents.size() == 1 && arrays.size() < 3)
      {
        arrays.push_back(axis->range(0, axis->extents[0]));
      }
    }
    const bool areSound =
      arrays.size() >= 2 && std::ranges::all_of(arrays, [&](const VtkArray& axis)
                              { return axis.values == arrays[0].values && isReal(axis.type); });
    if (!areSound || arrays[0].values < 1)
    {
      this->fail("the file has no coordinates of two or three axes: it is no mesh of Exodus");
    }
    return arrays;
  }

  /** A window of the file of its own, for arrays that are read at the same time. */
  InputFile& window()
  {
    return this->Windows.emplace_back(this->File.path(), ProgressFunction(), this->File.name());
  }

  void readNodes()
  {
    if (this->Coordinates[0].type == ScalarType::Float32)
    {
      this->Builder.useSinglePrecision();
    }
    std::deque<VtkArrayReader> readers;
    std::array<std::vector<double>, 3> values;
    constexpr std::int64_t AtOnce = 4096;
    for (std::size_t axis = 0; axis < this->Coordinates.size(); ++axis)
    {
      readers.emplace_back(
        axis == 0 ? this->File : this->window(), this->Coordinates[axis], this->Space);
    }
    for (std::vector<double>& axis : values)
    {
      axis.assign(AtOnce, 0.0);
    }
    for (std::int64_t node = 0; node < this->Nodes; node += AtOnce)
    {
      const auto count = static_cast<std::size_t>(std::min(AtOnce, this->Nodes - node));
      for (std::size_t axis = 0; axis < readers.size(); ++axis)
      {
        VtkArray array = this->Coordinates[axis];
        array.columnType = ScalarType::Float64;
        std::vector<std::byte> bytes(count * sizeOf(array.type));
        readers[axis].read(bytes.data(), count);
        convertVtkScalars(
          array, bytes.data(), count, reinterpret_cast<std::byte*>(values[axis].data()));
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        this->Builder.vertex(values[0][i], values[1][i], values[2][i]);
      }
    }
    readers.clear();
    this->Windows.clear();
  }

  /** The rows of a text variable. */
  std::vector<std::string> names(const std::string& variable)
  {
    const NetCdfVariable* const found = this->Variables.find(variable);
    std::vector<std::string> names;
    if (!found || found->extents.size() != 2 || found->extents[1] < 1)
    {
      return names;
    }
    const std::string all = this->Variables.characters(variable);
    const auto length = static_cast<std::size_t>(found->extents[1]);
    for (std::size_t begin = 0; begin + length <= all.size(); begin += length)
    {
      std::string name = all.substr(begin, length);
      name.resize(std::min(name.find('\0'), name.size()));
      name.resize(name.find_last_not_of(' ') + 1);
      names.push_back(std::move(name));
    }
    return names;
  }

  /** A short list of integers. */
  std::vector<std::int64_t> integers(const std::string& variable)
  {
    const NetCdfVariable* const found = this->Variables.find(variable);
    constexpr std::int64_t Most = 100000;
    if (!found || found->extents.size() != 1 || isReal(found->numbers.type) ||
        found->extents[0] > Most)
    {
      return {};
    }
    VtkIndexReader reader(this->File, found->range(0, found->extents[0]), this->Space);
    std::vector<std::int64_t> all;
    for (std::int64_t i = 0; i < found->extents[0]; ++i)
    {
      all.push_back(reader.next());
    }
    return all;
  }

  /** The numbers of the blocks or sets whose members `variable` has; those without one count from 1
   * on. */
  std::vector<std::int64_t> numbersOf(const std::string& property, const std::string& variable)
  {
    std::vector<std::int64_t> numbers = this->integers(property);
    while (this->Variables.find(variable + std::to_string(numbers.size() + 1)))
    {
      numbers.push_back(std::ssize(numbers) + 1);
    }
    return numbers;
  }

  /** Blocks and sets of this many dimensions, with a number and perhaps a name. */
  GroupSet groupOf(int dimension, std::int64_t number, const std::string& name)
  {
    GroupTable& groups = this->Builder.groups();
    // A block and a set of sides may have the same number.
    const auto [found, isNew] = this->NameOf.try_emplace({ dimension, number }, name);
    if (!isNew && found->second != name)
    {
      return groups.named(dimension, name.empty() ? "set " + std::to_string(number) : name);
    }
    const GroupSet set = groups.numbered(dimension, number);
    if (isNew && !name.empty())
    {
      groups.setName(dimension, number, name);
    }
    return set;
  }

  const std::vector<Block>& blocks()
  {
    if (!this->Blocks.empty())
    {
      return this->Blocks;
    }
    constexpr std::int64_t MostNodes = 1000; // of an element
    const std::vector<std::int64_t> numbers = this->numbersOf("eb_prop1", "connect");
    const std::vector<std::string> names = this->names("eb_names");
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      Block block;
      block.number = numbers[k];
      block.name = k < names.size() ? names[k] : "";
      const NetCdfVariable* const connect = this->Variables.find("connect" + std::to_string(k + 1));
      if (connect && connect->extents.size() == 2 && connect->extents[1] <= MostNodes)
      {
        block.type = connect->elementType.substr(0, connect->elementType.find('\0'));
        block.elements = connect->extents[0];
        block.nodes = connect->extents[1];
        block.connect = connect->range(0, block.elements * block.nodes);
        block.shape =
          exodusShape(block.type, block.nodes, static_cast<std::int64_t>(this->Coordinates.size()));
      }
      else if (connect)
      {
        this->fail("the elements of block " + std::to_string(block.number) +
                   " have different or too many nodes, which is not read");
      }
      this->Blocks.push_back(std::move(block));
    }
    return this->Blocks;
  }

  void readBlocks()
  {
    std::set<std::string> others;
    for (const Block& block : this->blocks())
    {
      if (block.elements == 0)
      {
        continue;
      }
      if (!block.shape)
      {
        others.insert(block.type);
      }
      this->Builder.setGroups(this->Builder.looks() || !block.shape
                                ? GroupTable::None
                                : this->groupOf(block.shape->dimension, block.number, block.name));
      VtkIndexReader reader(this->File, block.connect, this->Space);
      for (std::int64_t i = 0; i < block.elements; ++i)
      {
        const auto nodes = reader.next(static_cast<std::size_t>(block.nodes));
        if (!block.shape)
        {
          this->Builder.dropped();
          continue;
        }
        const auto corners = nodes.first(block.shape->corners);
        if (this->HasSides)
        {
          this->Listed.add(
            static_cast<std::uint32_t>(this->Builder.elements()), *block.shape, corners);
        }
        this->Builder.element(block.shape->dimension, corners, block.nodes > block.shape->corners);
      }
    }
    for (const std::string& type : others)
    {
      this->Builder.note("Elements of the type " + inQuotes(type) + " are left out.");
    }
  }

  void readNodeSets()
  {
    const std::vector<std::int64_t> numbers = this->numbersOf("ns_prop1", "node_ns");
    const std::vector<std::string> names = this->names("ns_names");
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      const NetCdfVariable* const nodes = this->Variables.find("node_ns" + std::to_string(k + 1));
      if (!nodes || nodes->extents.size() != 1)
      {
        continue;
      }
      const GroupSet set = this->groupOf(0, numbers[k], k < names.size() ? names[k] : "");
      VtkIndexReader reader(this->File, nodes->range(0, nodes->extents[0]), this->Space);
      for (std::int64_t i = 0; i < nodes->extents[0]; ++i)
      {
        const std::int64_t node = reader.next();
        this->Builder.grouped(0, std::span(&node, 1), set);
      }
    }
  }

  void readSideSets()
  {
    const std::vector<std::int64_t> numbers = this->numbersOf("ss_prop1", "elem_ss");
    const std::vector<std::string> names = this->names("ss_names");
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      this->SideSets.emplace_back(numbers[k], k < names.size() ? names[k] : "");
      const std::string index = std::to_string(k + 1);
      const NetCdfVariable* const elements = this->Variables.find("elem_ss" + index);
      const NetCdfVariable* const sides = this->Variables.find("side_ss" + index);
      if (!elements || !sides || elements->extents.size() != 1 ||
          elements->extents != sides->extents)
      {
        continue;
      }
      this->HasSides = true;
      const std::int64_t count = elements->extents[0];
      {
        VtkIndexReader ofElements(this->File, elements->range(0, count), this->Space);
        VtkIndexReader ofSides(this->window(), sides->range(0, count), this->Space);
        for (std::int64_t i = 0; i < count; ++i)
        {
          const std::int64_t element = ofElements.next(), side = ofSides.next();
          this->Listed.put(ListedNodes::placeOf(element), static_cast<std::uint32_t>(k),
            static_cast<std::uint32_t>(std::clamp<std::int64_t>(side, 0, 1000)));
        }
      }
      this->Windows.clear();
    }
  }

  void finishSides()
  {
    std::int64_t unknown = 0;
    unknown += this->Listed.finish(
      [&](const ListedElements::Found& found)
      {
        const ElementSide side = exodusSide(found.kind, found.corners.size(), found.side);
        const auto& [number, name] = this->SideSets[found.list];
        if (side.isWhole)
        {
          this->Builder.alsoIn(found.element, side.dimension, found.corners,
            this->groupOf(side.dimension, number, name));
          return;
        }
        std::array<std::int64_t, 4> corners{};
        for (std::size_t k = 0; k < side.corners.size(); ++k)
        {
          corners[k] = found.corners[side.corners[k]];
        }
        side.corners.empty()
          ? void(++unknown)
          : this->Builder.grouped(side.dimension, std::span(corners).first(side.corners.size()),
              this->groupOf(side.dimension, number, name));
      });
    if (unknown > 0)
    {
      this->Builder.note(counted(unknown, "side of a side set is", "sides of side sets are") +
                         " of no element that is read, and left out.");
    }
  }

  /** The variable of a result of nodes and, of old files, the first of its numbers. */
  std::pair<const NetCdfVariable*, std::int64_t> nodeResult(std::size_t index) const
  {
    const NetCdfVariable* found = this->Variables.find("vals_nod_var" + std::to_string(index));
    if (found && found->extents.size() == 2 && found->extents[1] == this->Nodes)
    {
      return { found, 0 };
    }
    found = this->Variables.find("vals_nod_var");
    const auto place = static_cast<std::int64_t>(index) - 1;
    const bool isSound = found && found->extents.size() == 3 && found->extents[2] == this->Nodes &&
                         place < found->extents[1];
    return { isSound ? found : nullptr, place * this->Nodes };
  }
  const NetCdfVariable* elementResult(std::size_t index, std::size_t block)
  {
    const NetCdfVariable* const found = this->Variables.find(
      "vals_elem_var" + std::to_string(index) + "eb" + std::to_string(block + 1));
    return found && found->extents.size() == 2 &&
               found->extents[1] == this->blocks()[block].elements
             ? found
             : nullptr;
  }

  void declareColumns()
  {
    if (this->Steps == 0)
    {
      return;
    }
    const std::vector<std::string> ofNodes = this->names("name_nod_var");
    for (std::size_t i = 0; i < ofNodes.size(); ++i)
    {
      if (const auto [variable, first] = this->nodeResult(i + 1); variable)
      {
        const ScalarType type = variable->numbers.type;
        this->NodeResults.push_back({ ofNodes[i], i + 1,
          ImportColumn(this->Builder, ColumnOf::Vertices, { ofNodes[i], type, 1 }), type });
      }
    }
    const std::vector<std::string> ofElements = this->names("name_elem_var");
    for (std::size_t i = 0; i < ofElements.size(); ++i)
    {
      const NetCdfVariable* variable = nullptr;
      for (std::size_t block = 0; block < this->blocks().size() && !variable; ++block)
      {
        variable = this->elementResult(i + 1, block);
      }
      if (variable)
      {
        const ScalarType type = variable->numbers.type;
        this->ElementResults.push_back({ ofElements[i], i + 1,
          ImportColumn(this->Builder, ColumnOf::Elements, { ofElements[i], type, 1 }), type });
      }
    }
  }

  void copy(const VtkArray& numbers, ImportColumn& column)
  {
    VtkArrayReader reader(this->File, numbers, this->Space);
    copyVtkTuples(
      reader, numbers.values, [] { return true; }, true,
      [&](std::span<const std::byte> tuples) { column.append(tuples); });
  }

  void fillColumns()
  {
    for (Result& result : this->NodeResults)
    {
      const auto [variable, first] = this->nodeResult(result.index);
      this->copy(variable->step(this->Step, first, this->Nodes), result.column);
      result.column.close();
    }
    for (Result& result : this->ElementResults)
    {
      for (std::size_t block = 0; block < this->Blocks.size(); ++block)
      {
        const std::int64_t elements = this->Blocks[block].elements;
        const NetCdfVariable* const variable = this->elementResult(result.index, block);
        if (variable && variable->numbers.type == result.type)
        {
          this->copy(variable->step(this->Step, 0, elements), result.column);
          continue;
        }
        // A block without the result.
        for (std::int64_t i = 0; i < elements; ++i)
        {
          const double none = std::numeric_limits<double>::quiet_NaN();
          const auto single = static_cast<float>(none);
          result.column.append(result.type == ScalarType::Float64
                                 ? std::as_bytes(std::span(&none, 1))
                                 : std::as_bytes(std::span(&single, 1)));
        }
      }
      result.column.close();
    }
  }

  InputFile& File;
  const NetCdfVariables& Variables;
  RawMeshBuilder& Builder;
  Workspace& Space;
  ListedElements Listed;
  std::deque<InputFile> Windows;
  std::int64_t Step = 0, Steps = 0, Nodes = 0;
  std::vector<VtkArray> Coordinates;
  std::vector<Block> Blocks;
  std::vector<std::pair<std::int64_t, std::string>> SideSets; ///< numbers and names
  std::map<std::pair<int, std::int64_t>, std::string> NameOf; ///< of groups with these numbers
  std::vector<Result> NodeResults, ElementResults;
  bool HasSides = false;
};

} // namespace

bool isExodus(const NetCdfVariables& variables)
{
  return variables.find("connect1") && (variables.find("coordx") || variables.find("coord"));
}

void readExodus(
  InputFile& file, const NetCdfVariables& variables, const MeshPart& part, RawMeshBuilder& builder)
{
  try
  {
    ExodusMeshReader(file, variables, builder).read(part);
  }
  catch (const MeshError& error)
  {
    throw Error(file.name() + ": " + error.what() + '.');
  }
}

std::vector<double> timesOfExodus(InputFile& file, const NetCdfVariables& variables)
{
  const NetCdfVariable* const found = variables.find("time_whole");
  std::vector<double> times;
  const std::int64_t steps = found && !found->extents.empty() ? found->extents[0] : 0;
  constexpr std::int64_t Most = 100000;
  if (steps > Most)
  {
    throw Error(
      file.name() + ": the file has " + std::to_string(steps) + " time steps, which are too many.");
  }
  Workspace space({}, Workspace::MinMemory);
  for (std::int64_t step = 0; step < steps; ++step)
  {
    const VtkArray one = found->step(step, 0, 1);
    std::array<std::byte, sizeof(double)> bytes{};
    VtkArrayReader(file, one, space).read(bytes.data(), 1);
    VtkArray converted = one;
    converted.columnType = ScalarType::Float64;
    convertVtkScalars(
      converted, bytes.data(), 1, reinterpret_cast<std::byte*>(&times.emplace_back()));
  }
  const bool ascend = std::ranges::adjacent_find(times, std::not_fn(std::less())) == times.end();
  if (!ascend || !std::ranges::all_of(times, [](double time) { return std::isfinite(time); }))
  {
    std::iota(times.begin(), times.end(), 0.0); // of a file that was written on, the numbers
  }
  return times;
}

} // namespace smg
