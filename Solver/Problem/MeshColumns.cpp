// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/MeshColumns.h"

#include "Solver/Core/Rounded.h"
#include "Solver/Core/Text.h"
#include "Solver/Mesh/AddedColumn.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

// The columns of a mesh that a description names, and what its error messages have in common. A
// mesh source delivers only the columns that are asked for, so every column is looked up in the
// StreamInfo before the mesh is read, where a misspelled name gives an error with the names that
// there are.

namespace smg
{

namespace
{

constexpr PoolUse SelectionMemory{ "finding the selected parts of the mesh",
  "raise the memory limit, or convert the mesh with the order bfs if it has another" };

const ColumnSpec* find(const std::vector<ColumnSpec>& specs, const std::string& name)
{
  const auto found = std::ranges::find(specs, name, &ColumnSpec::name);
  return found == specs.end() ? nullptr : &*found;
}

/** For example "'Normals' (3), 'PhysicalTag'". */
std::string listOf(const std::vector<ColumnSpec>& specs)
{
  std::string list;
  for (const ColumnSpec& spec : specs)
  {
    list += (list.empty() ? "'" : ", '") + spec.name + '\'';
    list += spec.components == 1 ? "" : " (" + std::to_string(spec.components) + ')';
  }
  return list.empty() ? "none" : list;
}

/** Adds the column of original indices, if it is needed, exists, and is not among the names
 * already. */
std::vector<std::string> withNumbers(std::vector<std::string> names, bool isNeeded,
  const std::vector<ColumnSpec>& specs, const ColumnSpec& numbers)
{
  if (isNeeded && findColumn(specs, numbers) >= 0 &&
      std::ranges::find(names, numbers.name) == names.end())
  {
    names.push_back(numbers.name);
  }
  return names;
}

} // namespace

/** Found by name, since a source delivers only some of the columns of the mesh. */
const Column& NamedColumn::in(const MeshBlock& block) const
{
  const bool ofCells = this->owner == ColumnOwner::Cells;
  const std::vector<Column>& columns = ofCells ? block.cellColumns : block.vertexColumns;
  const auto found = std::ranges::find_if(
    columns, [this](const Column& column) { return column.spec.name == this->name; });
  if (found == columns.end())
  {
    // An error of the calling program, which did not ask for vertexColumns() or cellColumns().
    throw Error(std::string("The mesh is read without the column '") + this->name + "' of its " +
                (ofCells ? "cells" : "vertices") + ", which the problem needs.");
  }
  return *found;
}

MeshColumns::MeshColumns(const StreamInfo& mesh, std::string description, Pool* memory)
  : Info(mesh)
  , Description(std::move(description))
  , Own(memory ? nullptr
               : std::make_unique<Pool>(std::numeric_limits<std::int64_t>::max(), SelectionMemory))
  , Memory(memory ? memory : this->Own.get())
{
}

/** If only one of both has the column, the preference does not matter. */
bool MeshColumns::isOfCells(const std::string& name, ColumnOwner preferred) const
{
  return find(this->Info.cellColumns, name) &&
         (preferred == ColumnOwner::Cells || !find(this->Info.vertexColumns, name));
}

/** Requests the column of its owner; the error lists what the mesh has. */
NamedColumn MeshColumns::require(
  const std::string& name, ColumnOwner preferred, const std::string& key)
{
  const bool ofCells = this->isOfCells(name, preferred);
  const ColumnSpec* spec = find(ofCells ? this->Info.cellColumns : this->Info.vertexColumns, name);
  if (!spec)
  {
    this->fail(key, "the mesh has no column '" + name + "'; its vertices have " +
                      listOf(this->Info.vertexColumns) + ", its cells " +
                      listOf(this->Info.cellColumns));
  }
  // Several entries may name the same column; it is read once.
  std::vector<std::string>& needed = ofCells ? this->Cells : this->Vertices;
  if (std::ranges::find(needed, name) == needed.end())
  {
    needed.push_back(name);
  }
  return { name, ofCells ? ColumnOwner::Cells : ColumnOwner::Vertices, spec->components };
}

bool MeshColumns::hasGroupColumn(GroupOf kind) const
{
  const auto& specs = kind == GroupOf::Vertices ? this->Info.vertexColumns : this->Info.cellColumns;
  return findColumn(specs, MeshGroups::columnSpec(kind, cornersOf(this->Info.cellType))) >= 0;
}

NamedColumn MeshColumns::requireGroups(GroupOf kind)
{
  return this->require(MeshGroups::columnOf(kind),
    kind == GroupOf::Vertices ? ColumnOwner::Vertices : ColumnOwner::Cells, "group");
}

/** Where columns are read, an error may name a vertex: then by its number in the original file. */
std::vector<std::string> MeshColumns::vertexColumns() const
{
  return withNumbers(this->Vertices, this->NeedsIds || !this->Vertices.empty(),
    this->Info.vertexColumns, OriginalIdSpec);
}

/** As for the vertices. */
std::vector<std::string> MeshColumns::cellColumns() const
{
  return withNumbers(this->Cells, this->NeedsCellIds || !this->Cells.empty(),
    this->Info.cellColumns, OriginalCellIdSpec);
}

/** The original indices, if the mesh has them; a source that leaves them out is an error where
 * regions need them. */
const Column* MeshColumns::ids(const MeshBlock& block) const
{
  const std::ptrdiff_t place = findColumn(block.vertexColumns, OriginalIdSpec);
  // Stream indices would be wrong numbers for a mesh that has original ones.
  if (place < 0 && this->NeedsIds && findColumn(this->Info.vertexColumns, OriginalIdSpec) >= 0)
  {
    throw Error(this->Description + ": the mesh is read without its column " + OriginalIdName +
                ", which the regions of vertices need.");
  }
  return place < 0 ? nullptr : &block.vertexColumns[static_cast<std::size_t>(place)];
}

std::string MeshColumns::vertexName(const MeshBlock& block, std::size_t i) const
{
  return "vertex " + nameOfRow(block.vertexColumns, OriginalIdSpec, block.firstVertex, i);
}

std::string MeshColumns::cellName(const MeshBlock& block, std::size_t c) const
{
  return "cell " + nameOfRow(block.cellColumns, OriginalCellIdSpec, block.firstCell, c);
}

/** The message has one line, whatever characters the names of columns have. */
void MeshColumns::fail(const std::string& key, const std::string& sentence) const
{
  throw Error(oneLine(this->Description + ": " + key + ": " + sentence + '.'));
}

/** Reads the whole solution once more, unless all columns have floating-point types, which do not
 * clip. */
void countClipped(Solution& solution, const std::vector<ColumnSpec>& columns, Report& report)
{
  // One range per component; component k of a value belongs to column k of the solution.
  std::vector<RoundedRange> ranges;
  for (const ColumnSpec& column : columns)
  {
    ranges.resize(ranges.size() + static_cast<std::size_t>(column.components),
      dispatch(column.type, []<class T>(T) { return RoundedRange::of<T>(); }));
  }
  report.clipped = 0;
  if (std::ranges::all_of(ranges, [](const RoundedRange& range) { return std::isinf(range.end); }))
  {
    return;
  }
  // The solution may be larger than the memory, and is read in parts.
  constexpr std::int64_t ChunkVertices = 1 << 14;
  std::vector<double> values;
  for (std::int64_t first = 0; first < solution.vertices(); first += ChunkVertices)
  {
    const std::int64_t count = std::min(ChunkVertices, solution.vertices() - first);
    values.resize(static_cast<std::size_t>(count) * ranges.size());
    solution.read(first, count, values);
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      // Rounded first, as on output: 255.4 is within the range of a byte.
      report.clipped += ranges[k % ranges.size()].contains(std::nearbyint(values[k])) ? 0 : 1;
    }
  }
  if (report.clipped > 0)
  {
    report.notes.push_back(std::to_string(report.clipped) +
                           (report.clipped == 1 ? " value was" : " values were") +
                           " outside the range of the type of a column, and became the smallest "
                           "or largest number of it.");
  }
}

} // namespace smg
