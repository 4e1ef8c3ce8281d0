// SPDX-License-Identifier: BSD-3-Clause
#include "IO/Arrays/AddedColumns.h"

#include "IO/Mesh/Columns.h"
#include "Solver/Files/Checksum.h"
#include "smg/Error.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

namespace smg
{
namespace
{

bool hasMeaning(const std::string& name)
{
  return isReservedColumn(name) || name == OriginalIdName || name == OriginalCellIdName ||
         name == CellFlagsName;
}

/** Of the vertices or of the cells of a source: which of its columns are added, in the order in
 * which they are asked for, and what the mesh itself is to deliver for that. */
class ChosenColumns
{
public:
  ChosenColumns(const std::vector<std::string>& names,
    const std::vector<AddedColumns::Added>& added, const OriginalRows& rows)
    : Rows(rows)
  {
    for (const std::string& name : names)
    {
      const auto found =
        std::ranges::find(added, name, [](const auto& column) { return column.spec.name; });
      if (found != added.end())
      {
        this->Parts.push_back(*found);
        this->IsAdding = true;
      }
      else
      {
        this->Parts.emplace_back();
        this->Stored.push_back(name);
      }
    }
    if (this->IsAdding && !rows.column.empty())
    {
      const auto numbers = std::ranges::find(this->Stored, rows.column);
      this->Numbers = numbers - this->Stored.begin();
      if (numbers == this->Stored.end())
      {
        this->Stored.push_back(rows.column);
        this->HasOwnNumbers = true;
      }
    }
  }

  const std::vector<std::string>& stored() const { return this->Stored; }

  /** The columns of the source, given those of the mesh's source, which may have more of them than
   * were asked for. */
  std::vector<ColumnSpec> specs(std::vector<ColumnSpec> stored)
  {
    if (this->HasOwnNumbers)
    {
      stored.erase(stored.begin() + this->Numbers);
    }
    std::vector<ColumnSpec> specs;
    std::size_t next = 0;
    for (const std::optional<AddedColumns::Added>& part : this->Parts)
    {
      specs.push_back(part ? part->spec : stored[next++]);
    }
    for (; next < stored.size(); ++next)
    {
      this->Parts.emplace_back();
      specs.push_back(stored[next]);
    }
    this->Specs = specs;
    return specs;
  }

  /** To be called around the next block of the mesh's source: lends that its columns, then makes
   * those of this one of them. */
  void lend(std::vector<Column>& columns) { columns.swap(this->Lent); }
  void complete(std::int64_t first, std::size_t tuples, std::vector<Column>& columns)
  {
    columns.swap(this->Lent);
    if (columns.size() != this->Specs.size())
    {
      columns = emptyColumns(this->Specs);
    }
    const Column* const numbers =
      this->Numbers >= 0 ? &this->Lent[static_cast<std::size_t>(this->Numbers)] : nullptr;
    for (std::size_t k = 0; k < columns.size(); ++k)
    {
      columns[k].spec = this->Specs[k];
      if (const std::optional<AddedColumns::Added>& part = this->Parts[k])
      {
        this->fill(*part, first, tuples, numbers, columns[k]);
      }
    }
    // Last, since a column of numbers is also one of those that move.
    std::size_t next = 0;
    for (std::size_t k = 0; k < columns.size(); ++k)
    {
      if (!this->Parts[k])
      {
        next += this->HasOwnNumbers && static_cast<std::ptrdiff_t>(next) == this->Numbers ? 1 : 0;
        columns[k].bytes.swap(this->Lent[next++].bytes);
      }
    }
  }

private:
  void fill(const AddedColumns::Added& part, std::int64_t first, std::size_t tuples,
    const Column* numbers, Column& column) const
  {
    column.resize(tuples);
    const std::size_t size = column.spec.tupleBytes();
    for (std::size_t i = 0; i < tuples; ++i)
    {
      part.values.copyRow(this->Rows.row(first, numbers, i), column.bytes.data() + i * size);
    }
  }

  const OriginalRows& Rows;
  std::vector<std::optional<AddedColumns::Added>> Parts; ///< of each column; none: of the mesh
  std::vector<std::string> Stored;
  std::vector<ColumnSpec> Specs;
  std::vector<Column> Lent;
  std::ptrdiff_t Numbers = -1;
  bool IsAdding = false;
  bool HasOwnNumbers = false; ///< the numbers were not asked for
};

class AddedSource : public MeshSource
{
public:
  AddedSource(const StoredMesh& mesh, std::shared_ptr<const OriginalOrder> order,
    ChosenColumns vertices, ChosenColumns cells)
    : Order(std::move(order))
    , OfVertices(std::move(vertices))
    , OfCells(std::move(cells))
    , Source(mesh.source(this->OfVertices.stored(), this->OfCells.stored()))
    , Info(this->Source->info())
  {
    this->Info.vertexColumns = this->OfVertices.specs(this->Info.vertexColumns);
    this->Info.cellColumns = this->OfCells.specs(this->Info.cellColumns);
  }

  const StreamInfo& info() const override { return this->Info; }
  bool readsOnAnyThread() const override { return this->Source->readsOnAnyThread(); }
  bool next(MeshBlock& block) override
  {
    this->OfVertices.lend(block.vertexColumns);
    this->OfCells.lend(block.cellColumns);
    if (!this->Source->next(block))
    {
      return false;
    }
    const auto corners = static_cast<std::size_t>(cornersOf(this->Info.cellType));
    this->OfVertices.complete(
      block.firstVertex, static_cast<std::size_t>(block.vertices()), block.vertexColumns);
    this->OfCells.complete(block.firstCell, block.corners.size() / corners, block.cellColumns);
    return true;
  }

private:
  std::shared_ptr<const OriginalOrder> Order; ///< which the selections refer to
  ChosenColumns OfVertices, OfCells;
  std::unique_ptr<MeshSource> Source;
  StreamInfo Info;
};

/** The checksum of the numbers of an array, wherever they lie. */
std::uint64_t checksumOf(const ArrayView& values)
{
  constexpr std::int64_t Rows = 4096;
  const std::size_t size = sizeOf(values.type) * static_cast<std::size_t>(values.columns);
  std::vector<std::byte> bytes;
  RunningChecksum sum;
  for (std::int64_t first = 0; first < values.rows; first += Rows)
  {
    const std::int64_t count = std::min(Rows, values.rows - first);
    bytes.resize(static_cast<std::size_t>(count) * size);
    for (std::int64_t i = 0; i < count; ++i)
    {
      values.copyRow(first + i, bytes.data() + static_cast<std::size_t>(i) * size);
    }
    sum.add(bytes);
  }
  return sum.value();
}

} // namespace

AddedColumns::AddedColumns(
  std::shared_ptr<const StoredMesh> mesh, std::shared_ptr<const OriginalOrder> order)
  : Mesh(std::move(mesh))
  , Order(std::move(order))
  , Info(this->Mesh->info())
{
}

void AddedColumns::add(
  bool ofCells, const std::string& name, const ArrayView& values, bool isArgument)
{
  const OriginalRows& rows = ofCells ? this->Order->cells() : this->Order->vertices();
  if (name.empty() || hasMeaning(name))
  {
    throw ArgumentError(
      '\'' + name + "': a column cannot have this name, which has a meaning of its own.");
  }
  if (values.rows != rows.count)
  {
    throw ArgumentError('\'' + name + "': has " + std::to_string(values.rows) +
                        " rows, but the mesh has " + std::to_string(rows.count) +
                        (ofCells ? " cells." : " vertices."));
  }
  const Added* const before = this->find(ofCells, name);
  const std::vector<ColumnSpec>& have = ofCells ? this->Info.cellColumns : this->Info.vertexColumns;
  if (isArgument && !(before && before->isArgument) &&
      std::ranges::find(have, name, &ColumnSpec::name) != have.end())
  {
    throw ArgumentError(
      '\'' + name + "': the mesh has a column of this name: give the argument another one.");
  }
  this->remove(ofCells, name);
  (ofCells ? this->OfCells : this->OfVertices)
    .push_back({ { name, values.type, static_cast<int>(values.columns) }, values, isArgument });
  this->setInfo();
}

void AddedColumns::remove(bool ofCells, const std::string& name)
{
  std::erase_if(ofCells ? this->OfCells : this->OfVertices,
    [&name](const Added& other) { return other.spec.name == name; });
  this->setInfo();
}

std::shared_ptr<const AddedColumns> AddedColumns::withoutArguments() const
{
  auto others = std::make_shared<AddedColumns>(*this);
  for (std::vector<Added>* columns : { &others->OfVertices, &others->OfCells })
  {
    std::erase_if(*columns, [](const Added& column) { return column.isArgument; });
  }
  others->setInfo();
  return others->isEmpty() ? nullptr : others;
}

void AddedColumns::setInfo()
{
  this->Info = this->Mesh->info();
  const auto merge = [](const std::vector<Added>& added, std::vector<ColumnSpec>& specs)
  {
    for (const Added& column : added)
    {
      const auto place = std::ranges::find(specs, column.spec.name, &ColumnSpec::name);
      place == specs.end() ? specs.push_back(column.spec) : void(*place = column.spec);
    }
  };
  merge(this->OfVertices, this->Info.vertexColumns);
  merge(this->OfCells, this->Info.cellColumns);
}

std::unique_ptr<MeshSource> AddedColumns::source(
  std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const
{
  return std::make_unique<AddedSource>(*this->Mesh, this->Order,
    ChosenColumns(vertexColumns, this->OfVertices, this->Order->vertices()),
    ChosenColumns(cellColumns, this->OfCells, this->Order->cells()));
}

std::string AddedColumns::fingerprint() const
{
  std::string text = this->Mesh->fingerprint();
  for (const std::vector<Added>* added : { &this->OfVertices, &this->OfCells })
  {
    for (const Added& column : *added)
    {
      char number[17];
      std::snprintf(number, sizeof number, "%016llx",
        static_cast<unsigned long long>(checksumOf(column.values)));
      text += (added == &this->OfCells ? " cells " : " vertices ") + column.spec.name + ' ' +
              std::string(nameOf(column.spec.type)) + ' ' + std::to_string(column.spec.components) +
              ' ' + number;
    }
  }
  return text;
}

void AddedColumns::completeIsolated(std::int64_t first, IsolatedVertices& vertices) const
{
  for (const Added& added : this->OfVertices)
  {
    std::erase_if(vertices.columns,
      [&added](const Column& column) { return column.spec.name == added.spec.name; });
    Column column{ added.spec, {} };
    column.resize(vertices.ids.size());
    const std::size_t size = column.spec.tupleBytes();
    for (std::size_t i = 0; i < vertices.ids.size(); ++i)
    {
      const std::int64_t row =
        this->Order->isolatedRow(first + static_cast<std::int64_t>(i), vertices.ids[i]);
      added.values.copyRow(row, column.bytes.data() + i * size);
    }
    vertices.columns.push_back(std::move(column));
  }
}

const AddedColumns::Added* AddedColumns::find(bool ofCells, const std::string& name) const
{
  const std::vector<Added>& added = ofCells ? this->OfCells : this->OfVertices;
  const auto found =
    std::ranges::find(added, name, [](const Added& column) { return column.spec.name; });
  return found == added.end() ? nullptr : &*found;
}

} // namespace smg
